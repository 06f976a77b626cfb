//! What takes long or needs other programs to verify: `make verify`, no part of `make test`.

mod verify {
    mod lammps;
    #[path = "../suite/specimens.rs"]
    #[allow(dead_code, reason = "the suite uses the rest")]
    mod specimens;
}
