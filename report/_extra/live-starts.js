/* The starts in the ball of the live page: computed as far as the reader sees the ball, coloured, cut open, and picked. */
(function (root) {
  "use strict";
  const { product, about, scaled } = root.liveSpace, { points, colourOf, legend, compute, FAST_S, SLOW_S } = root.liveMap;
  const DOT = 0.019, PAUSE_MS = 300, byId = id => document.getElementById(`live-${id}`);

  function make(ball, rules) {
    const every = points(), spots = every.flatMap(({ axis, angle }, i) => { // at 180 degrees, at both ends of the axis
      const at = scaled(angle / Math.PI, axis);
      return angle < Math.PI ? [{ i, at }] : [{ i, at }, { i, at: scaled(-1, at) }];
    });
    let times = [], goal = [1, 0, 0, 0], asked = "", wanted = null, waiting, stop = () => {}, isSeen = false, frame = null;

    const startOf = ({ axis, angle }) => product(about(axis, angle), goal);
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
      const dots = spots.map(({ i, at }) => ({ at, radius: DOT, colour: colourOf(times[i], never) }));
      ball.draw({ dots, isSolid: true });
      const done = Object.keys(times).length, lost = Object.values(times).filter(time => !Number.isFinite(time)).length;
      byId("counted").textContent = done === 0 ? "" : `${lost} of ${done} starts drawn do not settle`;
    }
    function hear(i, time) {
      times[i] = time;
      if (frame === null) frame = requestAnimationFrame(redraw);
    }
    function run() {
      stop();
      times = [];
      redraw();
      if (!wanted.word) return;
      stop = compute(wanted.word, rows(), wanted.settings, rules, hear);
    }
    function update(view, settings) { // after a pause, if it is another ball
      const word = view.ball === "none" ? "" : view[view.ball], own = JSON.stringify([word, view.goal, settings, view.bound > 1e9]);
      if (own === asked) return;
      asked = own;
      wanted = { word, settings };
      ({ goal } = view);
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
    byId("ramp-from").textContent = `${FAST_S} s`;
    byId("ramp-to").textContent = `${SLOW_S} s`;
    cut();
    new IntersectionObserver(([{ isIntersecting }], observer) => {
      if (!isIntersecting) return;
      observer.disconnect();
      isSeen = true;
      if (wanted) run();
    }).observe(byId("ball"));
    return { update, redraw, pick: k => startOf(every[spots[k].i]), times: () => times };
  }
  root.liveStarts = { make };
})(window);
