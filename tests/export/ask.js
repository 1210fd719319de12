const fs = require('fs');
const states = new Float64Array(fs.readFileSync('states').buffer.slice(0));
for (const [name, tuning] of Object.entries(JSON.parse(fs.readFileSync('laws.json', 'utf8')))) {
    const law = require(`./js/${name}/${name}.js`);
    const answers = new Float64Array(WIDTH_OUT * COUNT);
    for (let k = 0; k < COUNT; k++) {
        const s = states.subarray(25 * k, 25 * k + 25);
        const state = { memory_wxyz: Array.from(s.subarray(21, 25)) };
        const u = law.angular_acceleration(s.subarray(0, 9), s.subarray(9, 12), s.subarray(12, 21), ...tuning, state);
        answers.set([...u, ...state.memory_wxyz], WIDTH_OUT * k);
    }
    fs.writeFileSync(`${name}.answers`, Buffer.from(answers.buffer));
}
