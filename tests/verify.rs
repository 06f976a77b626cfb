//! What takes long or needs other programs to verify: `make verify`, no part of `make test`.

mod verify {
    mod gates;
    mod kills;
    mod lammps;
    mod ranks;
    mod slurm;
    #[path = "../suite/specimens.rs"]
    mod specimens;
    mod table;
}
