fn columns(R: &[Real; 9]) -> law::Rotation {
    law::Rotation { n: [R[0], R[3], R[6]], o: [R[1], R[4], R[7]], a: [R[2], R[5], R[8]] }
}
