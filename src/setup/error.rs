//! Why a case makes no specimen.

use crate::solver::SolverError;
use crate::study::{Refusal, Subject};
use crate::units::amounts;

/// Sound as a text, but not as physics.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", self.refusal())]
pub enum SetupError {
    /// Lengths in nm, times in ps, speeds in nm/ps.
    NoLattice {
        cutoff: f64,
        minimum: f64,
    },
    CutoffTooLong {
        cutoff: f64,
        minimum: f64,
        most: f64,
    },
    Endless {
        steps: u64,
        time_step: f64,
    },
    /// ps
    TooFewProbes {
        every: f64,
        time: f64,
    },
    /// An interval, and the shortest that has a meaning, ps.
    TooShort {
        subject: Subject,
        what: &'static str,
        interval: f64,
        least: f64,
        least_is: &'static str,
    },
    /// nm
    SpongesMeet {
        sponge: f64,
        height: f64,
    },
    SpongeTooThin {
        sponge: f64,
        row: f64,
    },
    FasterThanSound {
        speed: f64,
        sound: f64,
    },
    TooSmall {
        length: f64,
        width: f64,
        rows: i32,
        triangles: i32,
        block: u32,
        spacing: f64,
    },
    /// The longer side, its atoms, and how many can be numbered.
    TooLong {
        side: f64,
        is_width: bool,
        atoms: f64,
        most: f64,
    },
    ElementTooLarge {
        element: u32,
        rows: i32,
    },
    /// Cells per edge of a block.
    BlockTooLarge {
        element: u32,
    },
    /// Of the crack, and of the longest that leaves a bond, nm.
    CrackTooLong {
        crack: f64,
        longest: f64,
    },
    /// Of the crack, and the distance of two atoms, nm.
    CrackTooShort {
        crack: f64,
        shortest: f64,
    },
    /// Of the notch, of its middle, and of the first and the last bond along it, nm.
    NotchNotInside {
        length: f64,
        center: f64,
        bonds: [f64; 2],
    },
    /// Lengths of the notch as laid out and of the crack that ends the run, nm.
    NotchBeyondEnd {
        notch: f64,
        end: f64,
    },
    /// The crack length that ends the run, and how far a crack can come, nm.
    CrackOutOfReach {
        end: f64,
        longest: f64,
    },
    /// Bytes needed, and free on this machine.
    TooLarge {
        sites: u64,
        ranks: u32,
        needed: u64,
        present: u64,
    },
    /// How deep a face is that is held or moves, nm, and the cells per edge of the elements.
    FaceTooThin {
        depth: f64,
        element: u32,
    },
    /// What a solid may be asked for and this version cannot compute.
    NotThere {
        subject: Subject,
        message: &'static str,
        help: &'static str,
    },
    Solver(#[from] SolverError),
}

impl SetupError {
    /// What is wrong, and the part of the case to look at.
    pub fn refusal(&self) -> Refusal {
        match self {
            Self::NoLattice { cutoff, minimum } => Refusal::new(
                Subject::Cutoff,
                format!("this potential has no zero-pressure lattice within its cutoff of {cutoff} nm"),
                format!("its energy is lowest at {minimum:.4} nm: let the cutoff reach well beyond"),
            ),
            Self::CutoffTooLong { cutoff, minimum, most } => Refusal::new(
                Subject::Cutoff,
                format!(
                    "a cutoff of {cutoff} nm is more than {most} times the distance of lowest energy, {minimum:.4} nm: \
                     every site would have hundreds of partners"
                ),
                "write a shorter one",
            ),
            Self::Endless { steps, time_step } => Refusal::new(
                Subject::Until,
                format!("the run would take {:.1e} steps of {time_step:.3e} ps", *steps as f64),
                "look at the strain rate, the mass and `until`",
            )
            .with(Subject::Rate, "at this rate"),
            Self::TooFewProbes { every, time } => Refusal::new(
                Subject::Probes,
                format!(
                    "with a probe every {every:.3} ps a run of about {time:.3} ps is looked at too rarely to tell when \
                     anything happens"
                ),
                format!("probe every {:.2e} ps or more often", time / 100.0),
            )
            .with(Subject::Until, "of a run that ends here"),
            Self::TooShort {
                subject,
                what,
                interval,
                least,
                least_is,
            } => Refusal::new(
                *subject,
                format!("{what}, {interval:.2e} ps, is shorter than {least_is}, {least:.3} ps"),
                match subject {
                    Subject::Damping => format!("write a rate of at most {:.2e} /s", 1e12 / least),
                    _ => format!("let it be {least:.3} ps or longer"),
                },
            )
            .with(Subject::TimeStep, "in these steps"),
            Self::SpongesMeet { sponge, height } => Refusal::new(
                Subject::Sponge,
                format!("two sponges of {sponge} nm leave nothing of the {height:.2} nm between the grips for a crack"),
                "make the sponges thinner or the specimen wider",
            ),
            Self::SpongeTooThin { sponge, row } => Refusal::new(
                Subject::Sponge,
                format!("a sponge of {sponge} nm has no room for a row of elements, {row:.3} nm, and would take nothing out"),
                "make it thicker or the elements smaller, or leave it out",
            ),
            Self::FasterThanSound { speed, sound } => Refusal::new(
                Subject::Rate,
                format!("the grips would part at {speed:.3} nm/ps each, faster than sound ({sound:.3} nm/ps)"),
                "lower the strain rate",
            )
            .with(Subject::Width, "of this width"),
            Self::TooSmall {
                length,
                width,
                rows,
                triangles,
                block,
                spacing,
            } => Refusal::new(
                if *rows < 4 { Subject::Width } else { Subject::Length },
                format!(
                    "a specimen of {length} x {width} nm has room for {rows} rows of {triangles} triangles of {block} \
                     atoms per edge ({spacing:.4} nm apart); it needs 4 rows (two are grips) of at least 3"
                ),
                "make it larger, or `block` smaller",
            ),
            Self::TooLong {
                side,
                is_width,
                atoms,
                most,
            } => Refusal::new(
                if *is_width { Subject::Width } else { Subject::Length },
                format!("{side:.3e} nm are {atoms:.1e} atoms, and at most {most:.0e} along a side can be numbered"),
                "make it smaller: is the unit meant so?",
            ),
            Self::ElementTooLarge { element, rows } => Refusal::new(
                Subject::Element,
                format!(
                    "elements of {element} atoms per edge do not fit: either side of the crack plane has {rows} rows of \
                     atoms up to the grip"
                ),
                format!("use {rows} or less"),
            )
            .with(Subject::Width, "in this width"),
            Self::BlockTooLarge { element } => Refusal::new(
                Subject::Element,
                format!("a block of {element} cells per edge is larger than any solid"),
                "write for example 10",
            ),
            Self::CrackTooLong { crack, longest } => Refusal::new(
                Subject::Crack,
                format!(
                    "the crack ({crack} nm) leaves no bond whole: as laid out, the last is {longest:.2} nm from the edge at \
                     which it begins"
                ),
                "shorten the crack or lengthen the specimen",
            )
            .with(Subject::Length, "of this length"),
            Self::CrackTooShort { crack, shortest } => Refusal::new(
                Subject::Crack,
                format!("the crack ({crack} nm) is no longer than the distance of two atoms, {shortest:.3} nm"),
                "make it longer, or leave `crack` out",
            ),
            Self::NotchNotInside {
                length,
                center,
                bonds: [first, last],
            } => Refusal::new(
                Subject::Crack,
                format!(
                    "a notch of {length} nm around {center} nm leaves no bond whole at an edge: as laid out, the specimen has \
                     them from {first:.2} to {last:.2} nm"
                ),
                "shorten it or move `center`",
            )
            .with(Subject::Length, "of this length"),
            Self::NotchBeyondEnd { notch, end } => Refusal::new(
                Subject::UntilCrackLength,
                format!("the run would stop at once: as laid out, the notch is {notch:.2} nm long, and it stops at {end} nm"),
                "stop at a longer crack",
            )
            .with(Subject::Crack, "the notch"),
            Self::CrackOutOfReach { end, longest } => Refusal::new(
                Subject::UntilCrackLength,
                format!(
                    "no crack can grow to {end} nm: as laid out, the last bond is {longest:.2} nm from where the crack is \
                     measured"
                ),
                "stop at a shorter crack",
            )
            .with(Subject::Length, "in this length"),
            Self::TooLarge {
                sites,
                ranks,
                needed,
                present,
            } => {
                let (each, fewer) = match ranks {
                    1 => (String::new(), ""),
                    _ => (format!(" for {ranks} ranks"), "use fewer ranks, "),
                };
                Refusal::new(
                    Subject::Length,
                    format!(
                        "a mesh of {sites} sites{each} needs about {} and this machine has {} free",
                        amounts::bytes(*needed),
                        amounts::bytes(*present)
                    ),
                    format!("{fewer}make the specimen smaller, or use larger elements"),
                )
            }
            .with(Subject::Element, "with these elements"),
            Self::FaceTooThin { depth, element } => Refusal::new(
                Subject::Face,
                format!(
                    "no element lies whole within {depth:.3} nm of this face, where elements have {element} cells per edge: nothing \
                     would be held or moved"
                ),
                "take more layers, or smaller elements there",
            ),
            Self::NotThere { subject, message, help } => Refusal::new(*subject, *message, *help),
            Self::Solver(SolverError::StepTooLong { given, limit }) => Refusal::new(
                Subject::TimeStep,
                format!(
                    "the time step {given:.5} ps is above the stability limit {limit:.5} ps of this mesh and material"
                ),
                "choose a smaller one, or `time-step: auto`",
            ),
            Self::Solver(SolverError::OutrunByGrips { given, longest }) => Refusal::new(
                Subject::TimeStep,
                format!(
                    "in a time step of {given:.5} ps the grips outrun the specimen by more than a hundredth of the spacing of the \
                     lattice: it may have {longest:.5} ps"
                ),
                "choose a smaller one, or `time-step: auto`, a lower strain rate, or `ramp: initial-velocity`",
            )
            .with(Subject::Rate, "at this rate"),
            Self::Solver(other) => Refusal::new(
                Subject::Cutoff,
                other.to_string(),
                "look at the potential and the extents of the specimen",
            ),
        }
    }
}
