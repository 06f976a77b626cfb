//! What a published file says of itself, for whoever finds it alone.

use hdf5::Group;
use hdf5::types::VarLenUnicode;

/// Attributes of the root: the case and the program that computed it. Units stand on each dataset.
pub(super) fn put_provenance(root: &Group, case_id: &str) -> hdf5::Result<()> {
    for (name, text) in [
        ("case", case_id),
        ("program", concat!("cgaft ", env!("CARGO_PKG_VERSION"))),
        ("units", "in the attribute `units` of each dataset"),
    ] {
        let text: VarLenUnicode = text.parse().map_err(|_| "an attribute contains a zero byte")?;
        root.new_attr::<VarLenUnicode>().create(name)?.write_scalar(&text)?;
    }
    Ok(())
}
