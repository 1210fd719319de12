// cargo test; with the types of nalgebra, too: cargo test --features nalgebra
#![allow(clippy::approx_constant, clippy::excessive_precision)] // numbers of test vectors

/// In single precision the vectors of these kinds are compared, to CLOSE of the largest number of the answer, or of 1,
/// if the answer changes by less than a fiftieth of that where the arguments alone are rounded.
const KINDS: [&str; 3] = ["uniform", "near the goal", "spinning"];
const CLOSE: f64 = 1e-5;

macro_rules! ask {
    ($precision:ident) => {
        mod $precision {
            use NAME::$precision as law;
            use law::Real;

            fn at<const N: usize>(row: &[f64], first: usize) -> [Real; N] {
                core::array::from_fn(|at| row[first + at] as Real)
            }

            fn collect(parts: &[&[Real]]) -> Vec<f64> {
                parts.concat().into_iter().map(f64::from).collect()
            }
PLAIN

            #[cfg(feature = "nalgebra")]
            pub mod typed {
                use super::{at, collect, law, Real};
                use nalgebra::{Matrix3, Rotation3};

                fn to_matrix(row: &[f64], first: usize) -> Matrix3<Real> {
                    Matrix3::from_row_slice(&at::<9>(row, first))
                }

                fn to_rotation(row: &[f64], first: usize) -> Rotation3<Real> {
                    Rotation3::from_matrix_unchecked(to_matrix(row, first))
                }
TYPED
            }
        }
    };
}
ask!(double);
ask!(single);

fn is_wrong(found: &[f64], expected: &[f64], tolerance: f64) -> bool {
    !found.iter().zip(expected).all(|(x, y)| (x - y).abs() <= tolerance)
}

macro_rules! check {
    ($entry:ident, $rows:ident, $arguments:expr) => {
        #[test]
        fn $entry() {
            let (mut wrong, mut compared) = (Vec::new(), 0);
            for (kind, row) in &$rows {
                let (expected, tolerance) = (&row[$arguments..row.len() - 1], row[row.len() - 1]);
                let found = double::$entry(row);
                let mut is_off = is_wrong(&found, expected, tolerance);
                let close = CLOSE * expected.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
                let nearby = double::$entry(&row.map(|x| f64::from(x as f32)));
                if KINDS.contains(kind) && !is_wrong(&nearby, expected, 0.02 * close) {
                    compared += 1;
                    let rounded = single::$entry(row);
                    is_off |= is_wrong(&rounded, expected, close);
                    #[cfg(feature = "nalgebra")]
                    {
                        is_off |= double::typed::$entry(row) != found || single::typed::$entry(row) != rounded;
                    }
                }
                if is_off {
                    wrong.push((kind, row, found));
                }
            }
            assert!(wrong.is_empty(), "{} of {} vectors wrong, the first: {:?}", wrong.len(), $rows.len(), wrong[0]);
            assert!(2 * compared > $rows.iter().filter(|(kind, _)| KINDS.contains(kind)).count(), "{compared} in f32");
        }
    };
}
TESTS

ROWS
