/* What became of an episode of the live page, in words. */
(function (root) {
  "use strict";
  const DEG = 180 / Math.PI, NBSP = "\u00a0";

  const degrees = radians => {
    const angle = radians * DEG, short = Math.abs(180 - angle);
    return `${angle.toFixed(short > 1e-9 ? Math.max(0, Math.ceil(-Math.log10(short))) : 0)}°`;
  };
  function ending({ isDone, outcome, settling_s, angle, end_s }, rules) {
    if (!isDone) return "is still moving";
    const when = `at ${end_s.toFixed(2)}${NBSP}s`, away = degrees(angle);
    return {
      settled: `settles in ${(settling_s || 0).toFixed(2)}${NBSP}s`,
      stuck: `is stuck ${away} from the goal`,
      creeping: `still moves slowly at the end, ${away} from the goal`,
      oscillating: `oscillates, ${away} from the goal at the end`,
      "timed-out": `does not settle and ends ${away} from the goal`,
      diverged: `diverges ${when}`,
      singular: `is singular ${when} and gives no command`,
      saturated: `commands more than ${rules.command_limit.toLocaleString("en")}${NBSP}rad/s² ${when}`,
    }[outcome];
  }
  function turned({ samples }) {
    const steps = samples.slice(1).map(({ R }, i) => window.live.plant.angle_between(samples[i].R, R));
    return `${(steps.reduce((p, q) => p + q, 0) * DEG).toFixed(0)}°`;
  }
  const peak = ({ peak: most }, rules) => (most < rules.command_limit ? `${Number(most.toPrecision(3))}${NBSP}rad/s²` : "no bound");
  root.liveWords = { ending, turned, peak };
})(window);
