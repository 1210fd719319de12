// node test_NAME.js
const law = require('./NAME.js');
const { vectors } = require('./vectors.json');

let wrong = 0;
for (const one of vectors) {
    // a law with memory is at its first tick in the vectors at 180 degrees: after reset
    const kept = Object.keys(one.arguments).find((name) => name.startsWith('memory'));
    const state = { [kept]: one.arguments[kept] };
    if (one.kind === 'at 180°' && kept) law.reset(state);
    const given = Object.entries(one.arguments).flatMap(([name, value]) =>
        name === 'gains' ? value : name === kept ? [state] : [value]);
    const result = [law[one.entry](...given)].flat();
    const found = kept ? result.concat(state[kept]) : result;
    const expected = one.result.concat(one.memory);
    if (!expected.every((value, at) => Math.abs(found[at] - value) <= one.tolerance)) wrong += 1;
}
console.log(`NAME: ${wrong} of ${vectors.length} vectors wrong`);
process.exit(wrong ? 1 : 0);
