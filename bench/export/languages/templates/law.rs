HEADING

mod law {
    use super::Real;

LAW
}

READING
STATE
ENTRIES
/// The same on the types of nalgebra, whose matrices are by columns; unit quaternions are taken, too.
#[cfg(feature = "nalgebra")]
pub mod on_nalgebra {
    use super::OWN;
    use nalgebra::{Matrix3, Rotation3, Vector3};

    fn by_rows(matrix: &Matrix3<Real>) -> [Real; 9] {
        core::array::from_fn(|at| matrix[(at / 3, at % 3)])
    }

TYPED
}
