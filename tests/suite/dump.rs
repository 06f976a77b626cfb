#[test]
fn dump() {
    for entry in std::fs::read_dir("tests/study_files/bad").unwrap() {
        let p = entry.unwrap().path();
        let p = p.to_str().unwrap();
        let r = cgaft::study::read(p).and_then(|s| cgaft::plan::plan(&s));
        println!("@@@ {p}");
        match r {
            Ok(_) => println!("ACCEPTED"),
            Err(e) => {
                for m in e.mistakes() {
                    println!(
                        "@ {}:{} {}\n@   help: {}",
                        m.line.unwrap_or(0),
                        m.column.unwrap_or(0),
                        m.message,
                        m.help.unwrap_or_default()
                    );
                }
                println!("{e}");
            }
        }
    }
}
