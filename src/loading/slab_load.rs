//! What acts on a slab: grips that part, or actions between grips at rest.

use std::ops::Range;

use super::{Load, Stretching, Together};
use crate::domain::Ranks;
use crate::mesh::Mesh;
use crate::state::State;

/// The load of a slab.
pub enum SlabLoad {
    /// Grips that part, and so strain it.
    Stretching(Box<Stretching>),
    /// Actions on some of its nodes, none of which strains it evenly: its nominal strain stays 0. They know their nodes by
    /// number, so that its mesh stays as it is.
    Actions(Together<2>),
}

/// What a load has booked so far, node by node and element by element.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Booked {
    /// Impulse with which every node in grips that part was pulled, the lower grip first, eV ps/nm.
    pub impulses: Vec<f64>,
    /// Kinetic energy that sponges have taken from each of their elements, eV.
    pub absorbed: Vec<f64>,
    /// Work of each action on each of its nodes, one action after the other, eV.
    pub works: Vec<f64>,
}

impl From<Stretching> for SlabLoad {
    fn from(grips: Stretching) -> Self {
        Self::Stretching(Box::new(grips))
    }
}

impl From<Together<2>> for SlabLoad {
    fn from(actions: Together<2>) -> Self {
        Self::Actions(actions)
    }
}

impl SlabLoad {
    /// Grips that part; `None` where nothing strains the slab evenly.
    pub fn stretching(&self) -> Option<&Stretching> {
        match self {
            Self::Stretching(grips) => Some(grips),
            Self::Actions(_) => None,
        }
    }

    /// The same on another mesh of the specimen, if it can be. All ranks must ask for it together.
    pub fn go_over_to(&mut self, mesh: &Mesh, ranks: Ranks) {
        if let Self::Stretching(grips) = self {
            **grips = grips.on(mesh, ranks);
        }
    }

    /// Stretches a specimen from its reference positions to the strain of the start.
    pub fn pre_stretch(&self, mesh: &Mesh, state: &mut State) {
        if let Self::Stretching(grips) = self {
            grips.pre_stretch(mesh, state);
        }
    }

    /// Takes hold of what is held and sets the velocities of the start.
    pub fn start(&self, mesh: &Mesh, state: &mut State) {
        match self {
            Self::Stretching(grips) => grips.start(mesh, state),
            Self::Actions(actions) => actions.hold(state),
        }
    }

    /// 1/ps
    pub fn strain_rate(&self) -> f64 {
        self.stretching().map_or(0.0, |grips| grips.rate)
    }

    /// Nominal strain after a time, ps.
    pub fn strain(&self, time: f64) -> f64 {
        self.stretching().map_or(0.0, |grips| grips.strain(time))
    }

    /// When a nominal strain is reached, ps; infinite where it never is.
    pub fn time_of(&self, strain: f64) -> f64 {
        self.stretching().map_or(f64::INFINITY, |grips| grips.time_of(strain))
    }

    /// Force with which the specimen pulls grips that part together, eV/nm; not a number where none do.
    pub fn grip_force(&self, state: &State) -> f64 {
        self.stretching().map_or(f64::NAN, |grips| grips.grip_force(state))
    }

    /// Work done on the meshes that the specimen had before, eV.
    pub fn earlier_work(&self) -> f64 {
        self.stretching().map_or(0.0, Stretching::earlier_work)
    }

    /// Goes back to what [`Self::earlier_work`] gave.
    pub fn restore_earlier_work(&mut self, work: f64) {
        if let Self::Stretching(grips) = self {
            grips.restore_earlier_work(work);
        }
    }

    /// What has been booked so far. All ranks must ask for it together.
    pub fn booked(&self, ranks: Ranks) -> Booked {
        match self {
            Self::Stretching(grips) => Booked {
                impulses: grips.impulses(ranks),
                absorbed: grips.absorbed(ranks),
                works: Vec::new(),
            },
            Self::Actions(actions) => Booked {
                works: actions.booked(ranks),
                ..Booked::default()
            },
        }
    }

    /// What is booked before anything moves.
    pub fn nothing_booked(&self) -> Booked {
        let nothing = |count: usize| vec![0.0; count];
        match self {
            Self::Stretching(grips) => Booked {
                impulses: nothing(grips.held().len()),
                absorbed: nothing(grips.sponge_size()),
                works: Vec::new(),
            },
            Self::Actions(actions) => Booked {
                works: nothing(actions.node_count()),
                ..Booked::default()
            },
        }
    }

    /// Becomes the part of a rank that moves these ranges of nodes, with what all have booked so far.
    pub fn belong_to(&mut self, nodes: &[Range<usize>], booked: &Booked) {
        match self {
            Self::Stretching(grips) => grips.belong_to(nodes, &booked.impulses, &booked.absorbed),
            Self::Actions(actions) => {
                actions.keep_to(nodes);
                actions.restore(&booked.works);
            }
        }
    }

    fn load(&self) -> &dyn Load<2> {
        match self {
            Self::Stretching(grips) => grips.as_ref(),
            Self::Actions(actions) => actions,
        }
    }

    fn load_mut(&mut self) -> &mut dyn Load<2> {
        match self {
            Self::Stretching(grips) => grips.as_mut(),
            Self::Actions(actions) => actions,
        }
    }
}

impl Load<2> for SlabLoad {
    fn hold(&self, state: &mut State) {
        self.load().hold(state);
    }

    fn held(&self) -> Vec<u32> {
        self.load().held()
    }

    fn force(&mut self, state: &mut State, time: f64) {
        self.load_mut().force(state, time);
    }

    fn damp(&mut self, state: &mut State, nodes: &[Range<usize>], time: f64) {
        self.load_mut().damp(state, nodes, time);
    }

    fn book(&mut self, state: &State, time: f64) {
        self.load_mut().book(state, time);
    }

    fn work(&self, ranks: Ranks) -> f64 {
        self.load().work(ranks)
    }

    fn unresolved(&self, state: &State, time_step: f64, ranks: Ranks) -> f64 {
        self.load().unresolved(state, time_step, ranks)
    }

    fn longest_step(&self, spacing: f64) -> f64 {
        self.load().longest_step(spacing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::loading::{Action, Course, Hold, Push};

    fn actions() -> SlabLoad {
        let push: Box<dyn Action<2>> = Box::new(Push::new(vec![(0, 2.0)], [3.0, 0.0], Course::Rise { within: 0.0 }));
        let held: Box<dyn Action<2>> = Box::new(Hold::at_rest(vec![1]).along([false, true]));
        Together::new(vec![("loading".to_owned(), push), ("held".to_owned(), held)]).into()
    }

    fn state() -> State {
        State::at_rest([vec![0.0, 5.0], vec![0.0; 2]], vec![1.0; 2])
    }

    #[test]
    fn actions_strain_nothing_and_go_on_from_the_work_that_they_have_booked() {
        let (mut load, mut state) = (actions(), state());
        load.hold(&mut state);
        assert_eq!(state.mobility[1], [1.0, 0.0]);
        load.force(&mut state, 1.0);
        state.velocity[0][0] = 0.5;
        load.book(&state, 2.0);
        let booked = load.booked(Ranks::alone());
        // A force of 6 over a way of 1.
        assert_eq!(booked.works, [6.0, 0.0]);
        assert_eq!([load.strain(9.0), load.time_of(0.1)], [0.0, f64::INFINITY]);
        assert!(load.grip_force(&state).is_nan());
        let mut other = actions();
        assert_eq!(other.nothing_booked().works, [0.0; 2]);
        other.belong_to(std::slice::from_ref(&(0..2)), &booked);
        assert_eq!(other.work(Ranks::alone()), 6.0);
    }
}
