function columns(R) {
    if (R.length !== 9 || typeof R[0] !== 'number')
        throw new TypeError('a matrix is an array of nine numbers, by rows: R[3 * i + j]; flatten a nested one');
    return [[R[0], R[3], R[6]], [R[1], R[4], R[7]], [R[2], R[5], R[8]]];
}

function rows(R) {
    return [0, 1, 2].flatMap((i) => [R[0][i], R[1][i], R[2][i]]);
}

function kept(answer, state, name) {
    state[name] = answer[1];
    return answer[0];
}
