//! Wave gauges: patches of the specimen whose mean velocity and stress every probe records.

use super::probe::site_volume;
use crate::analysis::frame::Frame;
use crate::analysis::series::Setting;
use crate::forces::Measure;
use crate::mesh::Mesh;
use crate::state::State;

/// Where gauges stand on the way from the crack plane to the grips, and from the tip of the notch to its edge. Halfway,
/// waves are plane enough, and what leaves the tip has passed before it comes back.
const SHARE: f64 = 0.5;

/// Radius of a patch, as a share of half of the height, and no less than so many element edges and spacings.
const RADIUS_SHARE: f64 = 0.08;
const LEAST_ELEMENTS: f64 = 1.5;
const LEAST_SPACINGS: f64 = 5.0;

/// Patches of elements around fixed places.
#[derive(Clone, Debug, PartialEq)]
pub struct Gauges {
    /// nm from the left edge and from the crack plane.
    places: Vec<[f64; 2]>,
    /// Gauge, element and number of its sites.
    members: Vec<(u32, u32, u32)>,
}

impl Gauges {
    /// Above and below the tip of the notch, and along its faces where they lead to an edge; none without a crack.
    pub fn new(mesh: &Mesh, setting: &Setting) -> Self {
        let half = 0.5 * setting.height;
        let largest = mesh.elements.first().map_or(1, |element| element.size);
        let edges = LEAST_ELEMENTS * f64::from(largest);
        let radius = (RADIUS_SHARE * half).max(setting.spacing * LEAST_SPACINGS.max(edges));
        let tip = setting.crack_length;
        let upper = [[tip, SHARE * half], [tip - SHARE * tip, radius]];
        let count = match (setting.crack_row, setting.is_crack_inside()) {
            (None, _) => 0,
            (Some(_), true) => 1,
            (Some(_), false) => 2,
        };
        let frame = Frame::of(setting);
        let places = upper.into_iter().take(count).flat_map(|[x, y]| [[x, y], [x, -y]]);
        let places: Vec<[f64; 2]> = places.map(|place| frame.place(place)).collect();
        let mut members = Vec::new();
        for (number, element) in mesh.elements.iter().enumerate() {
            let centre = element.centre().map(|component| component * mesh.spacing);
            let centre = [centre[0] - setting.left_x, centre[1] - mesh.middle_height()];
            for (gauge, place) in places.iter().enumerate() {
                let beside = centre[1] * place[1] > 0.0;
                if beside && (centre[0] - place[0]).hypot(centre[1] - place[1]) <= radius {
                    members.push((gauge as u32, number as u32, element.site_count() as u32));
                }
            }
        }
        Self { places, members }
    }

    /// nm from the left edge and from the crack plane.
    pub fn places(&self) -> &[[f64; 2]] {
        &self.places
    }

    /// Elements in the patches.
    pub fn elements(&self) -> impl Iterator<Item = u32> {
        self.members.iter().map(|&(_, element, _)| element)
    }

    /// Mean velocity x, y (nm/ps) and virial stress xx, yy, xy (eV/nm^3) of every gauge; not numbers where a patch holds
    /// no element.
    pub fn read(&self, mesh: &Mesh, state: &State, measure: &Measure, setting: &Setting) -> Vec<[f64; 5]> {
        let mut sums = vec![([0.0; 5], 0.0); self.places.len()];
        let volume = site_volume(setting);
        for &(gauge, element, sites) in &self.members {
            let (sum, count) = &mut sums[gauge as usize];
            let [element, sites] = [element as usize, sites as usize];
            let weight = sites as f64 / mesh.elements[element].node_count() as f64;
            *count += sites as f64;
            for axis in 0..2 {
                sum[axis] += weight
                    * mesh
                        .nodes_of(element)
                        .map(|node| state.velocity[axis][node])
                        .sum::<f64>();
            }
            let virial = measure.virial(element);
            (0..3).for_each(|k| sum[2 + k] += virial[k] / volume);
        }
        sums.into_iter()
            .map(|(sum, count)| sum.map(|total| total / count))
            .collect()
    }
}
