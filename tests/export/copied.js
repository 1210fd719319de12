require('./laws.js');
const { laws, functions, plant } = globalThis.live, wrong = [];
for (const [word, { law, memory, needs }] of Object.entries(laws)) {
    const text = needs.map(name => functions[name].toString()).join('\n');
    const alone = new Function(`${text}\nreturn ${needs[needs.length - 1]};`)();
    const [R, R_d] = [[0.36, 0.48, 0.64, 0.48], [1, 0, 0, 0]].map(plant.from_quaternion);
    const goal = [R_d, [0, 0, 0], [0, 0, 0]];
    const [a, b] = [alone, law].map(one => JSON.stringify(one(R, [0.1, 0.2, 0.3], goal, [100, 20, 30, 0.01], memory)));
    if (a !== b || a.includes('null')) wrong.push(word);
}
console.log(JSON.stringify([Object.keys(laws).length, wrong]));
