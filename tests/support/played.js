(word, starts, settings, rules, seen) => starts.map(s => {
    const { laws, plant, outcomes } = globalThis.live;
    const [R, R_d] = [s.slice(0, 4), s.slice(7, 11)].map(plant.from_quaternion);
    const given = { ...settings, bound: settings.bound === null ? Infinity : settings.bound };
    const start = { R, omega: s.slice(4, 7), R_d, band: s[11] };
    const one = globalThis.liveEpisode.begin(laws[word], start, given, rules);
    one.advance(Infinity);
    const at = tick => (tick < one.tick ? one.samples[Math.round(tick / 5)].R.flat() : Array(9).fill(null));
    return [outcomes.indexOf(one.outcome), one.settled_tick ?? -1, one.tick, one.angle, ...seen.map(at).flat()];
})
