//! What a slab keeps beside the motion of its nodes, so that a run goes on as if it had never stopped.

use super::Slab;
use super::crack::Crack;
use crate::analysis::series::BondEvent;
use crate::lattice::triangular;
use crate::loading::Booked;

/// What the load has done, and what has been seen of the crack.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Kept {
    /// Impulses of grips that part, what sponges have taken and the works of actions so far.
    pub booked: Booked,
    /// Work done before the mesh last changed, eV; what follows counts from there.
    pub earlier_work: f64,
    /// The triangles of the mesh of the start that have become atoms, ascending.
    pub refined: Vec<u32>,
    /// How many interfaces between triangles had opened when it was looked at them.
    pub outruns: u64,
    /// Bonds broken at the last probe, ascending (column, row, direction).
    pub broken_bonds: Vec<[i32; 3]>,
    /// Bonds that the crack had parted by then, also where its faces touch, with the probes at which they broke, ascending
    /// (column, row, direction).
    pub parted_bonds: Vec<BondEvent>,
    /// The probes at which the crack joined one ahead of it.
    pub joins: Vec<u32>,
    /// Time at which the crack or the damage ahead of it last advanced, ps, the farthest tip and the front of the damage in the
    /// frame of the crack, nm; for the stop at arrest.
    pub last_advance: f64,
    pub farthest_tip: f64,
    pub damage_front: f64,
    /// When the crack first had a branch, ps, if the run is to end after it; infinite otherwise.
    pub branched: f64,
    /// When the crack left its plane, ps; infinite as long as it keeps to it.
    pub left_plane: f64,
}

impl Slab {
    pub(super) fn kept(&self) -> Kept {
        let ranks = self.forces.domain().ranks();
        let probes = &self.probes;
        let crack = probes.crack.as_ref();
        Kept {
            booked: self.loading.booked(ranks),
            earlier_work: self.loading.earlier_work(),
            refined: self
                .refinement
                .as_ref()
                .map_or_else(Vec::new, |refinement| refinement.refined().to_vec()),
            outruns: self.outruns(),
            broken_bonds: probes.broken.clone(),
            parted_bonds: crack.map_or_else(Vec::new, Crack::parted),
            joins: crack.map_or_else(Vec::new, |crack| crack.joins().to_vec()),
            last_advance: probes.watch.last_advance(),
            farthest_tip: probes.watch.farthest_tip(),
            damage_front: probes.watch.front(),
            branched: probes.watch.branched(),
            left_plane: probes.watch.left_plane(),
        }
    }

    pub(super) fn go_on_from(&mut self, open_interfaces: &[u32], kept: &Kept) {
        self.forces.restore_open_interfaces(open_interfaces);
        let nodes = self.forces.domain().nodes();
        self.loading.belong_to(&nodes, &kept.booked);
        self.loading.restore_earlier_work(kept.earlier_work);
        if let Some(refinement) = &mut self.refinement {
            refinement.restore_outruns(kept.outruns);
        }
        let probes = &mut self.probes;
        probes.broken.clone_from(&kept.broken_bonds);
        probes.crack = Crack::new(&self.setting);
        if let Some(crack) = &mut probes.crack {
            crack.go_on_from(&kept.parted_bonds, &kept.joins);
        }
        probes.watch.restore(
            kept.last_advance,
            [kept.farthest_tip, kept.damage_front],
            [kept.branched, kept.left_plane],
        );
    }

    pub(super) fn refuse_foreign(&self, open_interfaces: &[u32], kept: &Kept) -> Result<(), &'static str> {
        let (own, booked) = (self.loading.nothing_booked(), &kept.booked);
        if booked.impulses.len() != own.impulses.len() {
            return Err("its grips hold another number of nodes");
        }
        if booked.absorbed.len() != own.absorbed.len() {
            return Err("its sponges have another number of elements");
        }
        if booked.works.len() != own.works.len() {
            return Err("its loading acts on another number of nodes");
        }
        let interfaces = self.forces.interface_count();
        if open_interfaces.iter().any(|&number| number as usize >= interfaces) {
            return Err("it has other interfaces");
        }
        let mesh = self.forces.mesh();
        let exists = |[column, row, direction]: [i32; 3]| {
            usize::try_from(direction).is_ok_and(|direction| direction < triangular::NEAREST.len())
                && mesh.owner_of([column, row]).is_some()
        };
        let parted = kept.parted_bonds.iter();
        let parted = parted.map(|bond| [bond.column, bond.row, i32::from(bond.direction)]);
        if kept.broken_bonds.iter().copied().chain(parted).all(exists) {
            Ok(())
        } else {
            Err("it has bonds of other sites")
        }
    }
}
