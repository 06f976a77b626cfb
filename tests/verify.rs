//! What takes long or needs other programs to verify: `make verify`, no part of `make test`.

mod verify {
    mod gates;
    mod kills;
    mod lammps;
    mod mpi_solver;
    mod ranks;
    mod slurm;
    #[path = "../suite/specimens.rs"]
    mod specimens;
    mod table;
}
