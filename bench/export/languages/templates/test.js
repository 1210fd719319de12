// node test_NAME.js
const law = require('./NAME.js');
const { vectors } = require('./vectors.json');

let wrong = 0;
for (const one of vectors) {
    // a law with memory is at its first tick in the vectors at 180 degrees: after reset
    const state = { memory: [-1, -1, -1, -1] };
    if (one.kind === 'at 180°' && law.reset) law.reset(state);
    else state.memory = one.arguments.memory;
    const given = Object.entries(one.arguments).flatMap(([name, value]) =>
        name === 'gains' ? value : name === 'memory' ? [state] : [value]);
    const result = [law[one.entry](...given)].flat();
    const found = one.memory.length ? result.concat(state.memory) : result;
    const expected = one.result.concat(one.memory);
    if (!expected.every((value, at) => Math.abs(found[at] - value) <= one.tolerance)) wrong += 1;
}
console.log(`NAME: ${wrong} of ${vectors.length} vectors wrong`);
process.exit(wrong ? 1 : 0);
