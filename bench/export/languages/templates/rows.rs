fn rows(R: law::Rotation) -> [Real; 9] {
    core::array::from_fn(|at| [R.n, R.o, R.a][at % 3][at / 3])
}
