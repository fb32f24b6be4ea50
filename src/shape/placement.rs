//! [`Placement`]: where a mesh stands.

use glam::{Affine3A, DAffine3, DMat3, DVec3, Vec3};

/// An affine transformation of positions, normals and the order of corners.
#[derive(Clone, Debug)]
pub(crate) struct Placement {
    transform: Affine3A,
    /// The inverse transpose up to a positive factor, for normals. It exists even for singular transformations. In f64, because its
    /// products exceed the range of f32.
    cofactors: DMat3,
    /// Whether it turns right hands into left ones.
    pub is_mirrored: bool,
}

impl Placement {
    pub fn new(transform: &Affine3A) -> Self {
        let [x, y, z]: [DVec3; 3] =
            [transform.x_axis, transform.y_axis, transform.z_axis].map(|v| Vec3::from(v).into());
        let is_mirrored = x.cross(y).dot(z) < 0.0;
        let sign = if is_mirrored { -1.0 } else { 1.0 };
        let cofactors = sign * DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
        Self { transform: *transform, cofactors, is_mirrored }
    }

    #[inline]
    pub fn point(&self, p: Vec3) -> Vec3 {
        self.transform.transform_point3(p)
    }

    #[inline]
    pub fn normal(&self, n: Vec3) -> Vec3 {
        (self.cofactors * n.as_dvec3()).normalize_or_zero().as_vec3()
    }

    /// The corners in the order in which they are counter-clockwise from outside.
    #[inline]
    pub fn order<T>(&self, [a, b, c]: [T; 3]) -> [T; 3] {
        if self.is_mirrored { [a, c, b] } else { [a, b, c] }
    }

    /// The three rows of the matrix, each with its translation: coordinate i of a point is ((x row\[0\] + y row\[1\]) + z row\[2\]) +
    /// row\[3\], to the bit.
    pub fn rows(&self) -> [[f32; 4]; 3] {
        let Affine3A { matrix3, translation } = self.transform;
        let [x, y, z] = [matrix3.x_axis, matrix3.y_axis, matrix3.z_axis].map(|v| v.to_array());
        [0, 1, 2].map(|i| [x[i], y[i], z[i], translation.to_array()[i]])
    }

    /// From where points stand back to where they come from; `None` if that cannot be told.
    pub fn inverse(&self) -> Option<DAffine3> {
        let Affine3A { matrix3, translation } = self.transform;
        let columns = [matrix3.x_axis, matrix3.y_axis, matrix3.z_axis];
        let [x, y, z] = columns.map(|v| Vec3::from(v).as_dvec3());
        let transform = DAffine3::from_mat3_translation(
            DMat3::from_cols(x, y, z),
            Vec3::from(translation).as_dvec3(),
        );
        let inverse = transform.inverse();
        inverse.is_finite().then_some(inverse)
    }
}
