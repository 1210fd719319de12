/* One episode of a sampled controller on the free body, a few steps at a time: the loop of bench/engines/disturbed.py
   around the functions of `live` (bench/export/browser.py), which are translated from the sources that are measured.

   begin(law, start, settings, rules) -> { advance(steps), isDone, ... }
     law       one of live.laws
     start     { R, omega, R_d, band }: matrices by columns; band: haversine within which the law has settled
     settings  { kp, kv, period_s, delay_s, attitude_noise, rate_noise, worst_attitude_error, bound, inertia, horizon_s }
     rules     those of tasks/rules.py */
(function define(root) {
  "use strict";
  const STEP_S = 1e-3, SAMPLE_S = 5e-3, LEAD = 2, GOING = -1, AT_REST = [0, 0, 0];

  const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];

  function normals(seed) { // Box and Muller's, of a small generator that restarts with every episode
    let state = seed;
    const uniform = () => {
      state = (state + 0x6d2b79f5) | 0;
      let t = Math.imul(state ^ (state >>> 15), 1 | state);
      t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
      return (((t ^ (t >>> 14)) >>> 0) + 0.5) / 4294967296;
    };
    return () => Array.from({ length: 6 }, () => Math.sqrt(-2 * Math.log(uniform())) * Math.cos(2 * Math.PI * uniform()));
  }

  function begin(law, start, settings, rules) {
    const { plant, judge } = root.live, { R_d, band } = start;
    const steps = Math.max(1, Math.ceil(settings.period_s / STEP_S - 1e-9)), h = settings.period_s / steps;
    const late = Math.round(settings.delay_s / h), ticks = Math.max(1, Math.round(settings.horizon_s / h));
    const restTicks = Math.max(1, Math.round(rules.hold_s / h)), slots = Math.floor(late / steps) + 2;
    const isNoisy = settings.attitude_noise > 0 || settings.rate_noise > 0;
    const worst = settings.worst_attitude_error || 0, ahead = LEAD * (steps * h), draw = normals(1);
    const holdTicks = isNoisy ? ticks + 1 : restTicks, every = Math.max(1, Math.round(SAMPLE_S / h));
    const { kp, kv, delay_s, inertia, bound } = settings, goal = [R_d, AT_REST, AT_REST], sent = [];
    const gains = [kp, kv, bound, delay_s]; // a law may read the limits of its motors
    const slow = rules.slow_squared, isPrompt = late === 0 && steps === 1;
    const samples = [], commandLimit = rules.command_limit ** 2, speedLimit = rules.speed_limit ** 2;

    let { R, omega } = start, memory = law.memory, u = AT_REST, applied = AT_REST, tick = 0, period = 0, peak = 0;
    let failure = GOING, watch = judge.first_watch(plant.haversine(R, R_d), band, dot(omega, omega), slow);

    function noisy() { // orientation and rate with random errors
      if (!isNoisy) return [R, omega];
      const noise = draw(), a = settings.attitude_noise, b = settings.rate_noise;
      const about = a > 0 ? plant.turned(R, [a * noise[0], a * noise[1], a * noise[2]]) : R;
      const rate = b > 0 ? omega.map((value, i) => value + b * noise[3 + i]) : omega;
      return [about, rate];
    }
    function seen() { // and, near 180 degrees, with the worst error: away from the goal as it will be LEAD periods on
      const [about, rate] = noisy();
      if (!(worst > 0 && plant.angle_between(about, R_d) + worst > Math.PI)) return [about, rate];
      const [, v] = plant.turn_quaternion(plant.turned(about, rate.map(value => ahead * value)), R_d);
      const away = -worst / Math.sqrt(dot(v, v));
      return [plant.turned(about, v.map(value => away * value)), rate];
    }
    function ask() {
      const [about, rate] = seen();
      const answer = law.law(about, rate, goal, gains, memory);
      if (law.memory) [u, memory] = answer;
      else u = answer;
      u = plant.shortened(u, bound);
      failure = judge.check_command(dot(u, u), commandLimit);
      sent[period % slots] = u;
      period += 1;
    }
    function inEffect() {
      if (isPrompt) return u;
      return tick >= late ? sent[Math.floor((tick - late) / steps) % slots] : AT_REST;
    }
    function keep() {
      samples.push({ R, angle: plant.angle_between(R, R_d), command: Math.sqrt(dot(applied, applied)) });
    }
    function isGoing() { return failure === GOING && tick < ticks && watch[4] < holdTicks; }

    function oneStep() {
      if (tick === period * steps) ask();
      applied = inEffect();
      if (tick % every === 0) keep();
      peak = Math.max(peak, Math.sqrt(dot(applied, applied)));
      if (failure !== GOING) return;
      [R, omega] = plant.step(R, omega, applied, inertia, h);
      tick += 1;
      failure = judge.check_state(dot(omega, omega), speedLimit);
      if (failure !== GOING) return;
      watch = judge.watched(watch, tick, plant.haversine(R, R_d), band, dot(omega, omega), slow);
    }
    const episode = {
      samples,
      sample_s: every * h,
      isDone: false,
      advance(most) {
        for (let i = 0; i < most && isGoing(); i++) oneStep();
        if (isGoing() || episode.isDone) return;
        episode.isDone = true;
        keep();
        const { rest_speed: speed, rest_command: command } = rules;
        const code = judge.verdict(failure, watch, tick, restTicks, dot(omega, omega), dot(u, u), speed ** 2, command ** 2);
        const outcome = root.live.outcomes[code], settled = outcome === "settled" ? watch[1] : null;
        Object.assign(episode, { outcome, tick, peak, R, omega, settled_tick: settled });
        Object.assign(episode, { settling_s: settled === null ? null : settled * h, end_s: tick * h });
        episode.angle = plant.angle_between(R, R_d);
      },
    };
    return episode;
  }

  function bandOf(angle0, rules) {
    const half = angle0 < rules.at_goal_rad ? rules.floor_rad : rules.tolerance * angle0;
    return Math.sin(half / 2) ** 2;
  }
  root.liveEpisode = { begin, bandOf, source: String(define) };
})(typeof globalThis === "object" ? globalThis : this);
