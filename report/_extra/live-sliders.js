/* What can be set on the live page: range, what a place on the slider means, and the words for it. Without `usual` it is
   a part of the start. */
(function (root) {
  "use strict";
  const NBSP = "\u00a0";

  const inLogs = (from, to, unit) => ({
    from: 0, to: 1, step: 0.01,
    value: place => Number((from * (to / from) ** place).toPrecision(3)),
    place: value => Math.log(value / from) / Math.log(to / from),
    text: value => `${value}${NBSP}${unit}`,
  });
  const inSteps = (from, to, step, text) => ({ from, to, step, value: place => place, place: value => value, text });
  const limit = inLogs(10, 1000, "rad/s²");
  const SLIDERS = {
    angle: { label: "Angle to the goal", ...inSteps(0, 180, 0.5, value => `${Number(value.toFixed(2))}°`) },
    spin: { label: "Spin about that axis", ...inSteps(-20, 20, 0.5, value => `${Number(value.toFixed(1))}${NBSP}rad/s`) },
    kp: { label: "Gain Kp", usual: 100, ...inLogs(10, 1000, "/s²") },
    kv: { label: "Gain Kv", usual: 20, ...inLogs(2, 200, "/s") },
    rate: { label: "Control rate", usual: 1000, ...inLogs(10, 1000, "Hz") },
    delay: { label: "Delay", usual: 0, ...inSteps(0, 60, 1, value => `${value}${NBSP}ms`) },
    noise: { label: "Noise of the orientation", usual: 0, ...inSteps(0, 0.1, 0.002, value => `${value}${NBSP}rad`) },
    bound: {
      label: "Torque limit, over inertia", usual: Infinity, ...limit,
      value: place => (place >= 1 ? Infinity : limit.value(place)),
      place: value => (value === Infinity ? 1 : limit.place(value)),
      text: value => (value === Infinity ? "none" : limit.text(value)),
    },
    inertia: {
      label: "True inertia over the model's", usual: 1,
      ...inSteps(1, 4, 0.1, value => [value, 1, 1 / value].map(one => Number(one.toFixed(2))).join(" : ")),
    },
  };
  root.liveSliders = { SLIDERS };
})(window);
