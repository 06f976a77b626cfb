//! What one element adds to the integral.
//!
//! With b the lattice vector of a bond, d what it has become, f = phi'/r d its force, and all sums over the bonds of the
//! element, half of those it shares:
//!
//! P A = sum f b,   W A = sum (phi(d) - phi(b)),   u_i,J = sum (d - b)_i b_K (M^-1)_KJ,   M = sum b b,
//!
//! A the area of its sites; the last likewise for v and q. Stress and energy take all bonds within the cutoff, the
//! gradients those between nearest neighbours, which span the area evenly. Bonds that are severed or broken count nowhere.

use super::Rings;
use crate::analysis::series::RINGS;
use crate::lattice::triangular;
use crate::material::Material;
use crate::mesh::Mesh;
use crate::mesh::element::Element;
use crate::state::State;

/// The bonds of elements of one size, in local coordinates.
pub(super) struct BondTable {
    pub(super) size: i32,
    /// One of each pair of opposite vectors, and how many bonds inside the element it stands for.
    inside: Vec<(Arm, f64)>,
    /// Sites of the element and the vectors that leave it from there.
    leaving: Vec<([i32; 2], Arm)>,
}

/// A lattice vector.
#[derive(Clone, Copy)]
pub(super) struct Arm {
    local: [i32; 2],
    /// nm, in an upright element.
    vector: [f64; 2],
    /// Energy of the bond in the perfect lattice, eV.
    energy: f64,
    is_nearest: bool,
    /// Squared length at which it counts as broken, nm^2.
    broken: f64,
}

impl BondTable {
    /// Bonds this much longer than the cutoff (in spacings) may come within it while the lattice is strained.
    pub(super) const BEYOND_CUTOFF: f64 = 0.3;

    pub(super) fn new(size: i32, material: &Material) -> Self {
        let spacing = material.spacing;
        let arm = |local: [i32; 2]| {
            let vector = triangular::position(local).map(|component| component * spacing);
            let squared = f64::from(triangular::squared_length(local));
            Arm {
                local,
                vector,
                energy: material.interaction.evaluate(squared * spacing * spacing).energy,
                is_nearest: triangular::squared_length(local) == 1,
                broken: squared * material.breaking_length().powi(2),
            }
        };
        let reach = material.interaction.cutoff() / spacing + Self::BEYOND_CUTOFF;
        let element = Element {
            size,
            ..Element::atom([0, 0])
        };
        let ends = |local: [i32; 2], vector: [i32; 2]| [local[0] + vector[0], local[1] + vector[1]];
        let inside = triangular::half_vectors_within(reach).into_iter().map(|vector| {
            let count = element.locals().filter(|&local| element.contains(ends(local, vector)));
            (arm(vector), count.count() as f64)
        });
        // By vector, so that those that follow each other mostly lead to the same element.
        let leaving = triangular::vectors_within(reach).into_iter().flat_map(|vector| {
            let starts = element.locals();
            starts
                .filter(move |&local| !element.contains(ends(local, vector)))
                .map(move |local| (local, vector))
        });
        Self {
            size,
            inside: inside.filter(|(_, count)| *count > 0.0).collect(),
            leaving: leaving.map(|(local, vector)| (local, arm(vector))).collect(),
        }
    }

    /// Bonds that leave an element: from which of its sites, along what, and where they end.
    #[inline(always)]
    pub(super) fn leaving(&self, element: &Element) -> impl Iterator<Item = ([i32; 2], &Arm, [i32; 2])> {
        self.leaving.iter().map(|(local, arm)| {
            let end = [local[0] + arm.local[0], local[1] + arm.local[1]];
            (*local, arm, element.site(end))
        })
    }
}

/// A specimen in the middle of an evaluation.
pub(super) struct Field<'a> {
    pub mesh: &'a Mesh,
    pub material: &'a Material,
    pub tables: &'a [BondTable],
    pub state: &'a State,
    pub rings: &'a Rings,
    /// Where an element's nodes are among those gathered, plus one; zero where they are not.
    pub place: &'a [u32],
    pub nodes: &'a [Nodes],
}

/// Place, velocity and q of the rings at a node or a site; or their differences along a bond.
type Point = [f64; 4 + RINGS];

/// The nodes of an element; an atom's only one three times.
pub(super) type Nodes = [Point; 3];

/// Gathers the nodes of an element.
pub(super) fn nodes_of(mesh: &Mesh, state: &State, rings: &Rings, number: usize) -> Nodes {
    let element = &mesh.elements[number];
    let node = |node: usize, site: [i32; 2]| {
        let mut point = [0.0; 4 + RINGS];
        for axis in 0..2 {
            point[axis] = state.position[axis][node];
            point[2 + axis] = state.velocity[axis][node];
        }
        point[4..].copy_from_slice(&rings.weights(mesh.reference(site)));
        point
    };
    if element.is_atom() {
        return [node(mesh.node(number, 0), element.site([0, 0])); 3];
    }
    let last = element.size - 1;
    let corners = [[0, 0], [last, 0], [0, last]];
    [0, 1, 2].map(|k| node(mesh.node(number, k), element.site(corners[k])))
}

impl Field<'_> {
    pub(super) fn contribution(&self, number: usize) -> [f64; RINGS] {
        let element = &self.mesh.elements[number];
        let nodes = &self.nodes[self.place[number] as usize - 1];
        let cell = self.cell(element, nodes);
        let Some(gradient) = cell.gradient() else {
            return [0.0; RINGS];
        };
        let [[ux, uy], [vx, vy]] = [0, 2].map(|k| [gradient[k][0], gradient[k + 1][0]]);
        let State {
            velocity, force, mass, ..
        } = self.state;
        let mut sum = [0.0; RINGS];
        let mut kinetic = 0.0;
        for (node, point) in self.mesh.nodes_of(number).zip(nodes) {
            let [mx, my] = [0, 1].map(|axis| mass[node] * velocity[axis][node]);
            kinetic += 0.5 * (mx * velocity[0][node] + my * velocity[1][node]);
            let inertia = force[0][node] * ux + force[1][node] * uy - mx * vx - my * vy;
            (0..RINGS).for_each(|ring| sum[ring] += inertia * point[4 + ring]);
        }
        // P_iJ u_i,x - (W + T) d_xJ, times the area.
        let [[xx, xy], [yx, yy]] = cell.stress;
        let flux = [xx * ux + yx * uy - cell.energy - kinetic, xy * ux + yy * uy];
        for ring in 0..RINGS {
            let [qx, qy] = gradient[4 + ring];
            sum[ring] += flux[0] * qx + flux[1] * qy;
        }
        sum
    }

    fn cell(&self, element: &Element, nodes: &Nodes) -> Cell {
        let size = element.size;
        let table = self.tables.iter().find(|table| table.size == size);
        let table = table.expect("every size has its table");
        let sign = f64::from(element.sign);
        let mut cell = Cell::default();
        for (arm, count) in &table.inside {
            let ends = [[0, 0], arm.local].map(|local| interpolate(nodes, size, local));
            cell.add(self.material, arm, sign, *count, &ends);
        }
        let mut last = None;
        for (local, arm, other_site) in table.leaving(element) {
            let site = element.site(local);
            last = self.mesh.owner_beside(other_site, last);
            let Some(other) = last else {
                continue;
            };
            if self.mesh.severed(site, other_site) {
                continue;
            }
            let far = &self.mesh.elements[other];
            let place = (self.place[other] as usize).checked_sub(1);
            let gathered = place.map(|place| &self.nodes[place]);
            let far_end = match gathered {
                Some(nodes) => interpolate(nodes, far.size, far.local(other_site)),
                None => {
                    let nodes = nodes_of(self.mesh, self.state, self.rings, other);
                    interpolate(&nodes, far.size, far.local(other_site))
                }
            };
            let ends = [interpolate(nodes, size, local), far_end];
            cell.add(self.material, arm, sign, 0.5, &ends);
        }
        cell
    }
}

/// Linear between the nodes of an element, as its sites are.
#[inline(always)]
fn interpolate(nodes: &Nodes, size: i32, local: [i32; 2]) -> Point {
    if size == 1 {
        return nodes[0];
    }
    let edge = 1.0 / f64::from(size - 1);
    let [p, q] = local.map(|along| f64::from(along) * edge);
    let mut point = nodes[0];
    for k in 0..point.len() {
        point[k] += p * (nodes[1][k] - nodes[0][k]) + q * (nodes[2][k] - nodes[0][k]);
    }
    point
}

/// The sums over the bonds of one element.
#[derive(Default)]
struct Cell {
    /// f_i b_J, eV.
    stress: [[f64; 2]; 2],
    /// eV
    energy: f64,
    /// b b: xx, yy, xy, nm^2.
    span: [f64; 3],
    /// The change of displacement, velocity and q along each bond, times b.
    change: [[f64; 2]; 4 + RINGS],
}

impl Cell {
    #[inline(always)]
    fn add(&mut self, material: &Material, arm: &Arm, sign: f64, share: f64, [start, end]: &[Point; 2]) {
        let b = [sign * arm.vector[0], sign * arm.vector[1]];
        let mut change = *end;
        (0..change.len()).for_each(|k| change[k] -= start[k]);
        let d = [change[0], change[1]];
        let squared = d[0] * d[0] + d[1] * d[1];
        if squared >= arm.broken {
            return;
        }
        let value = material.interaction.evaluate(squared);
        self.energy += share * (value.energy - arm.energy);
        for i in 0..2 {
            (0..2).for_each(|j| self.stress[i][j] += share * value.slope * d[i] * b[j]);
        }
        if arm.is_nearest {
            change[0] -= b[0];
            change[1] -= b[1];
            self.span[0] += share * b[0] * b[0];
            self.span[1] += share * b[1] * b[1];
            self.span[2] += share * b[0] * b[1];
            for (sum, change) in self.change.iter_mut().zip(change) {
                (0..2).for_each(|j| sum[j] += share * change * b[j]);
            }
        }
    }

    /// Gradients of displacement, velocity and q; `None` where too few bonds are left to tell.
    #[inline(always)]
    fn gradient(&self) -> Option<[[f64; 2]; 4 + RINGS]> {
        /// Smallest determinant of the span over the square of its trace; a full set of bonds has 1/4, bonds along one
        /// line have none.
        const LEAST: f64 = 1e-3;
        let [xx, yy, xy] = self.span;
        let determinant = xx * yy - xy * xy;
        if determinant <= LEAST * (xx + yy) * (xx + yy) {
            return None;
        }
        let mut gradient = self.change;
        for [x, y] in &mut gradient {
            [*x, *y] = [(yy * *x - xy * *y) / determinant, (xx * *y - xy * *x) / determinant];
        }
        Some(gradient)
    }
}
