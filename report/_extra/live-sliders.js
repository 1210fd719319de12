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
  const DEG = 180 / Math.PI;
  const SLIDERS = {
    angle: { label: "Angle to the goal", ...inSteps(0, 180, 0.5, value => `${Number(value.toFixed(2))}°`) },
    spin: { label: "Initial spin about the axis of the rotation", ...inSteps(-20, 20, 0.5, value => `${Number(value.toFixed(1))}${NBSP}rad/s`) },
    off: {
      label: "Sensor error near 180°, δ", usual: 0,
      ...inSteps(0, 1.2, 0.01, value => (value ? `${value}${NBSP}rad (${(value * DEG).toFixed(0)}°)` : "none")),
    },
    kp: { label: "Gain Kp", usual: 100, ...inLogs(10, 1000, "/s²") },
    kv: { label: "Gain Kv", usual: 20, ...inLogs(2, 200, "/s") },
    rate: { label: "Control rate", usual: 1000, ...inLogs(10, 1000, "Hz") },
    delay: { label: "Delay", usual: 0, ...inSteps(0, 60, 1, value => `${value}${NBSP}ms`) },
    noise: { label: "Noise of the orientation", usual: 0, ...inSteps(0, 0.1, 0.002, value => `${value}${NBSP}rad`) },
    bound: {
      label: "Torque limit divided by inertia", usual: Infinity, ...limit,
      value: place => (place >= 1 ? Infinity : limit.value(place)),
      place: value => (value === Infinity ? 1 : limit.place(value)),
      text: value => (value === Infinity ? "none" : limit.text(value)),
    },
    inertia: {
      label: "True inertia divided by the inertia of the model", usual: 1,
      ...inSteps(1, 4, 0.1, value => [value, 1, 1 / value].map(one => Number(one.toFixed(2))).join(" : ")),
    },
  };
  const ABOVE = ["angle", "spin", "off"], byId = id => document.getElementById(`live-${id}`);
  const make = (tag, properties) => Object.assign(document.createElement(tag), properties);

  function add(moved) {
    for (const [name, { label, from, to, step, value }] of Object.entries(SLIDERS)) {
      const input = make("input", { type: "range", id: `live-${name}`, min: from, max: to, step });
      const output = make("output", { id: `live-${name}-now` }), row = make("p");
      output.setAttribute("for", input.id);
      row.append(make("label", { htmlFor: input.id, textContent: label }), output, input);
      byId(ABOVE.includes(name) ? "start-sliders" : "sliders").append(row);
      input.addEventListener("input", () => moved(name, value(Number(input.value))));
    }
  }
  function show(current) {
    for (const [name, { place, text, usual }] of Object.entries(SLIDERS)) {
      const input = byId(name), said = text(current[name]);
      if (document.activeElement !== input) input.value = place(current[name]);
      input.setAttribute("aria-valuetext", said);
      byId(`${name}-now`).textContent = said;
      input.parentElement.classList.toggle("changed", usual !== undefined && usual !== current[name]);
    }
  }
  root.liveSliders = { SLIDERS, add, show };
})(window);
