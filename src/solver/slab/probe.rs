//! What a probe reads off a moment.

use super::bins::Bins;
use crate::analysis::series::{BondEvent, Setting};
use crate::domain::Domain;
use crate::forces::Measure;
use crate::lattice::triangular;
use crate::mesh::Mesh;
use crate::mesh::element::Element;

/// What lies between the grips.
#[derive(Clone, Debug, PartialEq)]
pub struct Interior {
    sites: usize,
}

impl Interior {
    pub fn new(mesh: &Mesh) -> Self {
        let inside = mesh.elements.iter().filter(|element| mesh.grip_of(element) == 0);
        Self {
            sites: inside.map(Element::site_count).sum(),
        }
    }

    /// Average virial stress xx, yy, xy, eV/nm^3, over the reference area. All ranks must ask for it together.
    pub fn average_stress(&self, mesh: &Mesh, domain: &Domain, measure: &Measure, setting: &Setting) -> [f64; 3] {
        let sum = domain.sum_elements(|element| match mesh.grip_of(&mesh.elements[element]) {
            0 => measure.virial(element),
            _ => [0.0; 3],
        });
        sum.map(|virial| virial / (self.sites as f64 * site_volume(setting)))
    }
}

/// Mean length of the lattice rows, nm: their ends are the teeth of the sides, so that none is as long as the specimen from
/// tooth to tooth.
pub fn mean_length(mesh: &Mesh) -> f64 {
    mesh.sites.len() as f64 / f64::from(mesh.sites.rows()) * mesh.spacing
}

/// Reference area of a site times the thickness, nm^3.
pub fn site_volume(setting: &Setting) -> f64 {
    triangular::SITE_AREA * setting.spacing * setting.spacing * setting.thickness
}

/// Atoms an edge of the elements along the crack plane ahead of the notch; without a crack at mid-height.
pub fn element_at_crack(mesh: &Mesh) -> u32 {
    let row = mesh.sites.middle_row();
    let ahead = mesh.sites.columns(row).filter(|&column| {
        let x = triangular::position([column, row])[0];
        mesh.cut.is_none_or(|cut| cut.is_ahead(mesh, x))
    });
    let sizes = ahead
        .filter_map(|column| mesh.owner_of([column, row]))
        .map(|owner| mesh.elements[owner].size);
    sizes.max().unwrap_or(1) as u32
}

/// The bonds in which two ascending lists of broken bonds differ, by rising place.
pub fn bond_events(before: &[[i32; 3]], now: &[[i32; 3]], probe: u32) -> Vec<BondEvent> {
    let event = |[column, row, direction]: [i32; 3], broken: bool| BondEvent {
        probe,
        column,
        row,
        direction: direction as u8,
        broken,
    };
    let key = |bond: &[i32; 3]| [bond[1], bond[0], bond[2]];
    let closed = before
        .iter()
        .filter(|bond| now.binary_search_by_key(&key(bond), key).is_err());
    let opened = now
        .iter()
        .filter(|bond| before.binary_search_by_key(&key(bond), key).is_err());
    closed
        .map(|&bond| event(bond, false))
        .chain(opened.map(|&bond| event(bond, true)))
        .collect()
}

/// An element in a bin.
#[derive(Clone, Debug, PartialEq)]
struct Member {
    bin: u32,
    element: u32,
    sites: u32,
    /// How much of the element counts in the bin.
    share: f64,
}

/// Bins along the crack plane and the elements that fall into each.
#[derive(Clone, Debug, PartialEq)]
pub struct ProfileLine {
    bins: Bins,
    centres: Vec<f64>,
    members: Vec<Member>,
}

impl ProfileLine {
    /// Bins of half an element's edge and no less than two spacings, of the elements next to the crack plane: one
    /// element row on either side, and two rows of atoms.
    ///
    /// The stress of a triangle is one value, of its centre, and counts in the bin of that with all its sites; an atom stands
    /// for one spacing along its row, and counts in every bin with its share of that.
    ///
    /// `element`: atoms an edge along the crack plane of the mesh of the start. Where it has been refined since, the same bins
    /// hold the atoms of the same rows.
    pub fn new(mesh: &Mesh, setting: &Setting, element: u32) -> Self {
        let size = f64::from(element);
        let wanted = (0.5 * (size + 1.0)).max(2.0) * setting.spacing;
        let bins = Bins::no_narrower_than(wanted, setting.length);
        let middle = mesh.sites.middle_row();
        let reach = (element as i32).max(2);
        let mut members = Vec::new();
        for (number, element) in mesh.elements.iter().enumerate() {
            let rows = element.lowest_row()..element.lowest_row() + element.size;
            if rows.start < middle - reach || rows.end > middle + reach {
                continue;
            }
            let x = element.centre()[0] * mesh.spacing - setting.left_x;
            let length = if element.size == 1 { mesh.spacing } else { 0.0 };
            let shares = bins.spread(x, length).into_iter().filter(|&(_, share)| share > 0.0);
            members.extend(shares.map(|(bin, share)| Member {
                bin,
                element: number as u32,
                sites: element.site_count() as u32,
                share,
            }));
        }
        let centres = bins.centres();
        Self { bins, centres, members }
    }

    pub fn bins(&self) -> &Bins {
        &self.bins
    }

    pub fn centres(&self) -> &[f64] {
        &self.centres
    }

    /// Elements in the bins.
    pub fn elements(&self) -> impl Iterator<Item = u32> {
        self.members.iter().map(|member| member.element)
    }

    /// Average virial stress in every bin, eV/nm^3; not a number where a bin holds no element.
    pub fn stress(&self, measure: &Measure, setting: &Setting) -> Vec<[f64; 3]> {
        let mut sums = vec![([0.0; 3], 0.0); self.centres.len()];
        for member in &self.members {
            let (sum, count) = &mut sums[member.bin as usize];
            *count += member.share * f64::from(member.sites);
            let virial = measure.virial(member.element as usize);
            (0..3).for_each(|k| sum[k] += member.share * virial[k]);
        }
        let volume = site_volume(setting);
        sums.into_iter()
            .map(|(sum, count)| sum.map(|virial| virial / (count * volume)))
            .collect()
    }
}
