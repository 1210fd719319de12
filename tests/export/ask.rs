const SAVED: &str = "FOLDER";

fn at<const N: usize>(row: &[f64], first: usize) -> [f64; N] {
    core::array::from_fn(|at| row[first + at])
}

macro_rules! ask {
    ($law:ident $(, $state:ident)?) => {
        #[test]
        fn $law() {
            let states = std::fs::read(format!("{SAVED}/states")).unwrap();
            let states: Vec<f64> = states.chunks_exact(8).map(|x| f64::from_le_bytes(x.try_into().unwrap())).collect();
            let mut answers: Vec<f64> = Vec::new();
            for s in states.chunks_exact(25) {
                $(let mut $state = $law::double::State { memory_wxyz: at(s, 21) };)?
                answers.extend($law::double::angular_acceleration(&at(s, 0), &at(s, 9), &at(s, 12), KP, KV $(, &mut $state)?));
                $(answers.extend($state.memory_wxyz);)?
            }
            let bytes: Vec<u8> = answers.into_iter().flat_map(f64::to_le_bytes).collect();
            std::fs::write(format!("{SAVED}/{}.answers", stringify!($law)), bytes).unwrap();
        }
    };
}
