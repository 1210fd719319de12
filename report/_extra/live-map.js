/* The time in which a law settles from every start at rest, in the ball of rotation vectors. Workers run the episodes of
   live-episode.js with the laws of this page; a worker of a page that is opened as a file is made of the script's text.

   liveMap.compute(word, starts, settings, rules, heard) -> stop(); starts: rows as `bench.engines.episode` has them,
   heard(i, time): the settling time of the i-th start, infinite where the law does not settle.
   liveMap.scaleOf(times) -> { from, to }: the times at the two ends of the colours.
   liveMap.describeShells(times, starts) -> how many starts do not settle, at each angle of the starts. */
(function (root) {
  "use strict";
  const SHELLS = 10, GOLDEN = Math.PI * (3 - Math.sqrt(5)), PER_SHELL = 4 * Math.PI, MOST_WORKERS = 4, CHUNK = 40;
  const USUAL = { from: 0.5, to: 5 }, LOW = 0.05, HIGH = 0.95, NARROWEST = 1.1, STEPS = 24;
  const RAMP = [[33, 113, 181], [44, 162, 148], [160, 190, 80], [240, 196, 70], [232, 110, 50]];

  function points() { // on shells, evenly; of the outermost one half, for its other half are the same rotations
    const found = [];
    for (let shell = 1; shell <= SHELLS; shell++) {
      const count = Math.round(PER_SHELL * shell * shell), kept = shell < SHELLS ? count : count / 2;
      for (let i = 0; i < kept; i++) {
        const z = 1 - (2 * i + 1) / count, across = Math.sqrt(1 - z * z), turn = GOLDEN * i;
        found.push({ axis: [across * Math.cos(turn), across * Math.sin(turn), z], angle: (Math.PI * shell) / SHELLS });
      }
    }
    const later = i => (i * GOLDEN) % 1; // the whole ball at once, and then finer
    return found.map((one, i) => [later(i), one]).sort(([p], [q]) => p - q).map(([, one]) => one);
  }
  function scaleOf(times) { // of few starts that settle it is the usual one
    const finite = times.filter(Number.isFinite).sort((p, q) => p - q), last = finite.length - 1;
    if (last < 1) return USUAL;
    const [from, to] = [LOW, HIGH].map(share => finite[Math.round(share * last)]);
    return { from, to: Math.max(to, NARROWEST * from) };
  }
  function colourOf(time_s, never, { from, to } = USUAL) {
    if (time_s === undefined) return null;
    if (!Number.isFinite(time_s)) return never;
    const share = Math.log(time_s / from) / Math.log(to / from);
    const place = (Math.round(Math.max(0, Math.min(1, share)) * STEPS) / STEPS) * (RAMP.length - 1);
    const i = Math.min(Math.floor(place), RAMP.length - 2), part = place - i;
    return `rgb(${RAMP[i].map((value, k) => Math.round(value + part * (RAMP[i + 1][k] - value))).join(" ")})`;
  }
  const legend = () => `linear-gradient(to right, ${RAMP.map(colour => `rgb(${colour.join(" ")})`).join(", ")})`;

  function describeShells(times, starts) { // not one share of all starts: that would depend on how many lie on a shell
    const shells = new Map(), number = value => value.toLocaleString("en");
    starts.forEach(({ angle }, i) => {
      const { all, lost } = shells.get(angle) || { all: 0, lost: 0 };
      shells.set(angle, { all: all + 1, lost: lost + (Number.isFinite(times[i]) ? 0 : 1) });
    });
    const parts = [];
    let others = 0;
    for (const [angle, { all, lost }] of [...shells].sort(([p], [q]) => q - p)) {
      const isHalfTurn = angle === Math.PI, degrees = Math.round((angle * 180) / Math.PI);
      if (lost || isHalfTurn) parts.push(`at ${isHalfTurn ? "exactly " : ""}${degrees}°: ${number(lost)} of ${number(all)}`);
      else others += all;
    }
    return [...parts, ...(others ? [`elsewhere: 0 of ${number(others)}`] : [])].join("; ");
  }

  function serve({ data: { word, starts, settings, rules, chunk } }) { // runs in the worker, which has the rest
    for (let first = 0; first < starts.length; first += chunk) {
      const times = starts.slice(first, first + chunk).map(row => {
        const [R, R_d] = [row.slice(0, 4), row.slice(7, 11)].map(self.live.plant.from_quaternion);
        const start = { R, omega: row.slice(4, 7), R_d, band: row[11] };
        const episode = self.liveEpisode.begin(self.live.laws[word], start, settings, rules);
        episode.advance(Infinity);
        return episode.settling_s === null ? Infinity : episode.settling_s;
      });
      self.postMessage({ first, times });
    }
  }
  function compute(word, starts, settings, rules, heard) {
    const parts = [document.getElementById("live-laws").textContent, `(${root.liveEpisode.source})(self);`, `onmessage = ${serve};`];
    const address = URL.createObjectURL(new Blob([parts.join("\n")], { type: "text/javascript" }));
    const stride = Math.max(1, Math.min(MOST_WORKERS, (navigator.hardwareConcurrency || 2) - 1));
    const workers = Array.from({ length: stride }, (_, k) => {
      const worker = new Worker(address);
      worker.onmessage = ({ data: { first, times } }) => times.forEach((time, i) => heard(k + stride * (first + i), time));
      worker.postMessage({ word, starts: starts.filter((_, i) => i % stride === k), settings, rules, chunk: CHUNK });
      return worker;
    });
    return () => { workers.forEach(one => one.terminate()); URL.revokeObjectURL(address); };
  }
  root.liveMap = { points, scaleOf, colourOf, describeShells, legend, compute };
})(window);
