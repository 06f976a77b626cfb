use super::Planes;
use crate::mesh::Mesh;

/// The affine map by which a triangle carries its sites: x(p, q) = origin + p along[0] + q along[1].
/// [Deng2011] Eq. (3-27) with area coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine {
    pub origin: [f64; 2],
    pub along: [[f64; 2]; 2],
}

impl Affine {
    #[inline(always)]
    pub fn of_triangle(mesh: &Mesh, triangle: usize, position: &Planes) -> Self {
        let [a, b, c] = mesh
            .corners_of(triangle)
            .map(|node| [position[0][node], position[1][node]]);
        let edge = 1.0 / f64::from(mesh.elements[triangle].size - 1);
        let along = [
            [(b[0] - a[0]) * edge, (b[1] - a[1]) * edge],
            [(c[0] - a[0]) * edge, (c[1] - a[1]) * edge],
        ];
        Self { origin: a, along }
    }

    /// Position of the site at local coordinates.
    #[inline(always)]
    pub fn at(&self, [p, q]: [i32; 2]) -> [f64; 2] {
        let step = self.vector([p, q]);
        [self.origin[0] + step[0], self.origin[1] + step[1]]
    }

    /// The vector that p steps along one edge and q along the other make.
    #[inline(always)]
    pub fn vector(&self, [p, q]: [i32; 2]) -> [f64; 2] {
        let [p, q] = [f64::from(p), f64::from(q)];
        [
            p * self.along[0][0] + q * self.along[1][0],
            p * self.along[0][1] + q * self.along[1][1],
        ]
    }

    /// Twice the signed area of one lattice triangle; not positive: inside out.
    #[inline(always)]
    pub fn determinant(&self) -> f64 {
        self.along[0][0] * self.along[1][1] - self.along[0][1] * self.along[1][0]
    }

    /// Deformation gradient with respect to the perfect lattice of this spacing; `sign` is the triangle's orientation.
    /// Columns are the images of the unit vectors along x and y.
    #[inline(always)]
    pub fn deformation_gradient(&self, sign: i32, spacing: f64) -> [[f64; 2]; 2] {
        let scale = f64::from(sign) / spacing;
        let [a, b] = self.along;
        let across = scale * INVERSE_ROOT_3;
        let column = |axis: usize| (2.0 * b[axis] - a[axis]) * across;
        [[a[0] * scale, a[1] * scale], [column(0), column(1)]]
    }
}

/// The unit vector along y is (2 a2 - a1)/sqrt(3) in terms of the lattice vectors.
pub const INVERSE_ROOT_3: f64 = 0.577_350_269_189_625_8;

/// Smallest factor by which a deformation gradient (columns) stretches any vector.
#[inline(always)]
pub fn smallest_stretch(gradient: [[f64; 2]; 2]) -> f64 {
    let [[a, b], [c, d]] = gradient;
    let half_trace = 0.5 * (a * a + b * b + c * c + d * d);
    let determinant = a * d - b * c;
    let root = (half_trace * half_trace - determinant * determinant).max(0.0).sqrt();
    (half_trace - root).max(0.0).sqrt()
}

/// Current position of a site of an element.
pub fn site_position(mesh: &Mesh, element: usize, local: [i32; 2], position: &Planes) -> [f64; 2] {
    if element < mesh.triangles {
        return Affine::of_triangle(mesh, element, position).at(local);
    }
    let node = mesh.node(element, 0);
    [position[0][node], position[1][node]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gradient_of_the_perfect_lattice_is_the_identity_for_both_orientations() {
        let spacing = 0.25;
        for sign in [1, -1] {
            let step = f64::from(sign) * spacing;
            let along = [[step, 0.0], [0.5 * step, step * crate::lattice::triangular::ROW_HEIGHT]];
            let affine = Affine {
                origin: [0.0, 0.0],
                along,
            };
            let gradient = affine.deformation_gradient(sign, spacing);
            let expected = [[1.0, 0.0], [0.0, 1.0]];
            for k in 0..2 {
                (0..2).for_each(|axis| assert!((gradient[k][axis] - expected[k][axis]).abs() < 1e-15));
            }
            assert!((smallest_stretch(gradient) - 1.0).abs() < 1e-7);
        }
    }
}
