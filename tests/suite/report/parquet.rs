use super::{COLUMNS, files, three_meshes, written};

#[test]
fn every_table_is_there_as_parquet_too() {
    let tables = files(&written(&three_meshes()).path().join("tables"));
    for (table, _) in COLUMNS {
        let bytes = &tables[&format!("{table}.parquet")];
        assert!(bytes.starts_with(b"PAR1") && bytes.ends_with(b"PAR1"), "{table}");
    }
}
