/* The starts in the ball of the live page: computed as far as the reader sees the ball, coloured, cut open, and picked.

   The chosen law is computed from every start, and the other one from the first SAMPLE of them, which are spread over the
   whole ball: the scale of the colours is that of both laws from these, and the same whichever is chosen. */
(function (root) {
  "use strict";
  const { product, about, scaled } = root.liveSpace, DEG = 180 / Math.PI;
  const { points, scaleOf, colourOf, describeShells, legend, compute } = root.liveMap;
  const DOT = 0.019, PAUSE_MS = 300, SAMPLE = 400, byId = id => document.getElementById(`live-${id}`);

  function make(ball, rules) {
    const every = points(), spots = every.flatMap(({ axis, angle }, i) => { // at 180 degrees, at both ends of the axis
      const at = scaled(angle / Math.PI, axis);
      return angle < Math.PI ? [{ i, at }] : [{ i, at }, { i, at: scaled(-1, at) }];
    });
    let times = [], others = [], goal = [1, 0, 0, 0], asked = "", wanted = null, waiting, stops = [], isSeen = false;
    let frame = null, marked = null;

    const startOf = ({ axis, angle }) => product(about(axis, angle), goal);
    const computed = () => Object.keys(times).length;
    function rows() {
      const { from_quaternion, angle_between } = root.live.plant, R_d = from_quaternion(goal);
      return every.map(one => {
        const q = startOf(one), band = root.liveEpisode.bandOf(angle_between(from_quaternion(q), R_d), rules);
        return [...q, 0, 0, 0, ...goal, band];
      });
    }
    function redraw() { // once a frame, as times come in
      frame = null;
      const never = getComputedStyle(byId("ball")).color;
      const scale = scaleOf([...times.slice(0, SAMPLE), ...others]);
      const dots = spots.map(({ i, at }) => ({ at, radius: DOT, colour: colourOf(times[i], never, scale) }));
      ball.draw({ dots, isSolid: true });
      byId("ramp-from").textContent = computed() ? `≤ ${scale.from.toFixed(2)} s` : "";
      byId("ramp-to").textContent = computed() ? `≥ ${scale.to.toFixed(2)} s` : "";
      sayCounts();
      sayMarked();
    }
    function sayCounts() { // the numbers of all starts, once all are there: of a part they would say nothing
      const counted = byId("counted"), done = computed(), isDone = done === every.length;
      if (wanted && !wanted.word) counted.textContent = "";
      else if (!isDone) counted.textContent = `Computing … ${done} of ${every.length} starts`;
      else counted.textContent = `Starts from which law ${wanted.side.toUpperCase()} does not settle: ${describeShells(times, every)}.`;
      counted.setAttribute("aria-busy", String(!isDone));
    }
    function sayMarked() { // the dot in the ring of the ball
      if (marked === null) { byId("dot").textContent = ""; return; }
      const { i } = spots[marked], time = times[i], angle = `${Math.round(every[i].angle * DEG)}°`;
      const words = time === undefined ? "" : Number.isFinite(time) ? `, settles in ${time.toFixed(2)} s` : ", does not settle";
      byId("dot").textContent = `Dot in the ring: ${angle} from the goal${words}`;
    }
    const askForFrame = () => { if (frame === null) frame = requestAnimationFrame(redraw); };
    function run() {
      halt();
      redraw();
      if (!wanted.word) return;
      const all = rows(), { word, other, settings } = wanted;
      stops = [compute(word, all, settings, rules, (i, time) => { times[i] = time; askForFrame(); })];
      if (other === word) return;
      stops.push(compute(other, all.slice(0, SAMPLE), settings, rules, (i, time) => { others[i] = time; askForFrame(); }));
    }
    function halt() {
      for (const stop of stops) stop();
      [times, others, stops] = [[], [], []];
    }
    function update(view, settings) { // after a pause, if it is another ball; the old one is gone at once
      const side = view.ball, word = side === "none" ? "" : view[side], other = view[side === "a" ? "b" : "a"];
      const own = JSON.stringify([word, other, view.goal, settings, view.bound > 1e9]);
      if (own === asked) return;
      asked = own;
      wanted = { side, word, other, settings };
      ({ goal } = view);
      halt();
      redraw();
      clearTimeout(waiting);
      if (isSeen) waiting = setTimeout(run, PAUSE_MS);
    }
    function cut() {
      const depth = Number(byId("cut").value);
      ball.draw({ cut: depth });
      byId("cut").setAttribute("aria-valuetext", depth >= 1 ? "whole" : `cut ${Math.round(50 * (1 - depth))} % deep`);
    }
    byId("cut").addEventListener("input", cut);
    byId("ramp").style.background = legend();
    cut();
    new IntersectionObserver(([{ isIntersecting }], observer) => {
      if (!isIntersecting) return;
      observer.disconnect();
      isSeen = true;
      if (wanted) run();
    }).observe(byId("ball"));
    return {
      update,
      redraw,
      pick: k => startOf(every[spots[k].i]),
      describe(k) { marked = k; sayMarked(); },
    };
  }
  root.liveStarts = { make };
})(window);
