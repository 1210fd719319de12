const fs = require('fs');
const states = new Float64Array(fs.readFileSync('states').buffer.slice(0));
for (const [name, gains] of Object.entries(JSON.parse(fs.readFileSync('laws.json', 'utf8')))) {
    const law = require(`./js/${name}/${name}.js`);
    const answers = new Float64Array(WIDTH_OUT * COUNT);
    for (let k = 0; k < COUNT; k++) {
        const s = states.subarray(25 * k, 25 * k + 25);
        const state = { memory_wxyz: Array.from(s.subarray(21, 25)) };
        const [R, omega, R_d] = [[0, 9], [9, 12], [12, 21]].map(([first, end]) => s.subarray(first, end));
        const u = law.angular_acceleration(R, omega, R_d, ...gains, state);
        answers.set([...u, ...state.memory_wxyz], WIDTH_OUT * k);
    }
    fs.writeFileSync(`${name}.answers`, Buffer.from(answers.buffer));
}
