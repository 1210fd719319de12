/* The time in which a law settles from every start at rest, in the ball of rotation vectors. Workers run the episodes of
   live-episode.js with the laws of this page; a worker of a page that is opened as a file is made of the script's text.

   liveMap.compute(word, starts, settings, rules, heard) -> stop(); starts: rows as `bench.engines.episode` has them,
   heard(i, time): the settling time of the i-th start, infinite where the law does not settle. */
(function (root) {
  "use strict";
  const SHELLS = 10, GOLDEN = Math.PI * (3 - Math.sqrt(5)), PER_SHELL = 4 * Math.PI, MOST_WORKERS = 4, CHUNK = 40;
  const FAST_S = 0.5, SLOW_S = 5, STEPS = 24;
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
  function colourOf(time_s, never) {
    if (time_s === undefined) return null;
    if (!Number.isFinite(time_s)) return never;
    const share = Math.log(time_s / FAST_S) / Math.log(SLOW_S / FAST_S);
    const place = (Math.round(Math.max(0, Math.min(1, share)) * STEPS) / STEPS) * (RAMP.length - 1);
    const i = Math.min(Math.floor(place), RAMP.length - 2), part = place - i;
    return `rgb(${RAMP[i].map((value, k) => Math.round(value + part * (RAMP[i + 1][k] - value))).join(" ")})`;
  }
  const legend = () => `linear-gradient(to right, ${RAMP.map(colour => `rgb(${colour.join(" ")})`).join(", ")})`;

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
  root.liveMap = { points, colourOf, legend, compute, FAST_S, SLOW_S };
})(window);
