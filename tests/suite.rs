//! All integration tests in one program, one module a part, so that the heavy crates are linked once.

mod suite {
    mod analysis;
    mod cli;
    mod end_to_end;
    mod executor;
    mod forces;
    mod formulas;
    mod hard_cases;
    mod j_integral;
    mod notches;
    mod published;
    mod record;
    mod relaxation;
    mod report;
    mod small_model;
    mod solids;
    mod solver;
    mod specimens;
    mod store;
    mod study_files;
    mod synthetic;
    mod tidy;
}
