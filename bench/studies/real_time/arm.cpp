// The arm's side of the loop, a library that loop.py calls: an arm that moves with the clock, from
// event to event.
//
// An event is the end of a substep, the instant of a state (a tick), or the instant at which
// torques were written. The arm moves to each instant exactly: torques change where they arrived,
// not at the next substep. While an answer is awaited the arm moves up to an instant only after the
// clock has reached it, and after a look for torques that are older. Once the newest state is
// answered nothing can happen before the next tick: the arm moves there at once, and the process
// sleeps, which leaves the processor to others.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "shared.hpp"

constexpr int64_t NEVER = -1;
constexpr int64_t PATIENCE_NS = 10'000'000'000;
// Sleep ends so long before a tick: a virtual machine needs some 50 us to wake a process.
constexpr int64_t WAKING_NS = 100'000;
// A command beyond this [N m] is that of a loop that is lost. MuJoCo refuses 1e10 and what is not
// finite.
constexpr double MOST_TORQUE = 1e9;

// What is recorded of a tick. Instants count from the begin of the episode, by the clock;
// applied_ns by the arm's time.
struct Record {
    double q[MOST_JOINTS], qdot[MOST_JOINTS];
    int64_t published_ns;         // when the state was in shared memory
    int64_t read_ns, written_ns;  // when the controller had read it, and written torques
    int64_t noticed_ns;           // when the arm's process saw these
    int64_t applied_ns;           // from when on the arm has them
};

struct Setting {
    int64_t ticks, substeps, period_ns;
    double torque_rate;  // greatest change of a torque [N m/s]
};

class Episode {
  public:
    Episode(const mjModel *model, mjData *data, Shared &shared, const Setting &setting,
            Record *records)
        : model(model),
          data(data),
          shared(shared),
          setting(setting),
          records(records),
          n(model->nv) {
        mju_copy(wanted, data->ctrl, n);
    }

    // Run by the clock; return whether the controller has answered the last state.
    bool run_in_real_time() {
        began_ns = read_clock_ns();
        int64_t tick = 1;
        for (; tick <= setting.ticks && !is_lost; ++tick) {
            publish(tick);
            for (int64_t substep = 1; substep <= setting.substeps;) {
                const int64_t end_ns = end_of(tick, substep);
                // The clock first: torques that the look below does not see are written later than
                // this.
                const int64_t clock_ns = read_clock_ns() - began_ns;
                notice_answers();
                if (has_pending() && pending_instant() <= end_ns) {
                    apply_pending();
                } else if (clock_ns >= end_ns || newest_applied == tick) {
                    move_to(end_ns);
                    ++substep;
                }
            }
            sleep_until(end_of(tick, setting.substeps));
        }
        leave_out_from(tick);
        return wait_for(tick - 1);
    }

    // Run as fast as it goes. Torques that answer the state of tick i arrive at applied_ns[i - 1]
    // of an earlier episode.
    bool replay(const int64_t *applied_ns) {
        began_ns = read_clock_ns();
        int64_t tick = 1;
        for (; tick <= setting.ticks && !is_lost; ++tick) {
            const bool is_answered = applied_ns[tick - 1] != NEVER;
            if (is_answered) {
                publish(tick);
                if (!wait_for(tick)) return false;
                notice_answers();
            } else {
                keep_state(tick);
            }
            for (int64_t substep = 1; substep <= setting.substeps;) {
                const int64_t end_ns = end_of(tick, substep);
                const int64_t arrival_ns = has_pending() ? applied_ns[pending().tick - 1] : NEVER;
                if (has_pending() && arrival_ns <= end_ns) {
                    move_to(arrival_ns);
                    apply(pending());
                } else {
                    move_to(end_ns);
                    ++substep;
                }
            }
        }
        leave_out_from(tick);
        return true;
    }

  private:
    const mjModel *model;
    mjData *data;
    Shared &shared;
    const Setting &setting;
    Record *records;
    const int n;
    int64_t began_ns = 0, arm_ns = 0;
    int64_t noticed = 0, applied = 0;  // numbers of answers
    int64_t newest_applied = 0;        // tick of the newest of them
    double wanted[MOST_JOINTS];        // torques of the newest answer
    bool is_lost = false;

    int64_t end_of(int64_t tick, int64_t substep) const {
        return (tick - 1) * setting.period_ns + substep * setting.period_ns / setting.substeps;
    }

    // The states of a lost arm are not numbers, so that no comparison with them holds.
    void leave_out_from(int64_t tick) {
        for (; tick <= setting.ticks; ++tick) {
            Record &record = records[tick - 1];
            forget_instants(record);
            std::fill_n(record.q, MOST_JOINTS, std::numeric_limits<double>::quiet_NaN());
            std::fill_n(record.qdot, MOST_JOINTS, std::numeric_limits<double>::quiet_NaN());
        }
    }

    static void forget_instants(Record &record) {
        record.published_ns = record.read_ns = record.written_ns = NEVER;
        record.noticed_ns = record.applied_ns = NEVER;
    }

    State keep_state(int64_t tick) {
        Record &record = records[tick - 1];
        State state{};
        mju_copy(state.q, data->qpos, n);
        mju_copy(state.qdot, data->qvel, n);
        mju_copy(record.q, data->qpos, n);
        mju_copy(record.qdot, data->qvel, n);
        forget_instants(record);
        return state;
    }

    void publish(int64_t tick) {
        shared.states[tick % SLOTS] = keep_state(tick);
        records[tick - 1].published_ns = read_clock_ns() - began_ns;
        shared.tick.store(tick, std::memory_order_release);
        sem_post(&shared.is_new);
    }

    // Sleep until shortly before an instant of the episode, and look at the clock for the rest.
    void sleep_until(int64_t instant_ns) const {
        const int64_t early_ns = began_ns + instant_ns - WAKING_NS;
        if (read_clock_ns() < early_ns) {
            const timespec early{early_ns / 1'000'000'000, early_ns % 1'000'000'000};
            clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &early, nullptr);
        }
        while (read_clock_ns() < began_ns + instant_ns) {
        }
    }

    bool wait_for(int64_t tick) const {
        const int64_t end_ns = read_clock_ns() + PATIENCE_NS;
        while (read_clock_ns() < end_ns) {
            const int64_t number = shared.answered.load(std::memory_order_acquire);
            if (number > 0 && shared.answers[number % SLOTS].tick == tick) return true;
        }
        return false;
    }

    void notice_answers() {
        const int64_t newest = shared.answered.load(std::memory_order_acquire);
        if (noticed == newest) return;
        const int64_t clock_ns = read_clock_ns() - began_ns;
        while (noticed < newest) {
            const Answer &answer = shared.answers[++noticed % SLOTS];
            Record &record = records[answer.tick - 1];
            record.read_ns = answer.read_ns - began_ns;
            record.written_ns = answer.written_ns - began_ns;
            record.noticed_ns = clock_ns;
        }
    }

    bool has_pending() const { return applied < noticed; }
    const Answer &pending() const { return shared.answers[(applied + 1) % SLOTS]; }
    int64_t pending_instant() const { return pending().written_ns - began_ns; }

    // The arm may be past the instant by the time between the controller's look at the clock and
    // its write.
    void apply_pending() {
        move_to(std::max(arm_ns, pending_instant()));
        apply(pending());
    }

    void apply(const Answer &answer) {
        mju_copy(wanted, answer.tau, n);
        for (int joint = 0; joint < n; ++joint) {
            if (!(std::fabs(wanted[joint]) < MOST_TORQUE)) is_lost = true;
        }
        if (is_lost) mju_copy(wanted, data->ctrl, n);
        records[answer.tick - 1].applied_ns = arm_ns;
        newest_applied = answer.tick;
        ++applied;
    }

    // Half of the way at the old rates, new rates, half of the way at these: exact if the
    // acceleration is constant.
    void move_to(int64_t instant_ns) {
        const double seconds = 1e-9 * double(instant_ns - arm_ns);
        if (seconds <= 0.0) return;
        mju_addToScl(data->qpos, data->qvel, 0.5 * seconds, n);
        const double most = setting.torque_rate * seconds;
        for (int joint = 0; joint < n; ++joint) {
            data->ctrl[joint] += std::clamp(wanted[joint] - data->ctrl[joint], -most, most);
        }
        mj_forward(model, data);
        mju_addToScl(data->qvel, data->qacc, seconds, n);
        mju_addToScl(data->qpos, data->qvel, 0.5 * seconds, n);
        arm_ns = instant_ns;
    }
};

extern "C" {
bool run_in_real_time(const mjModel *model, mjData *data, Shared *shared, const Setting *setting,
                      Record *records) {
    return Episode(model, data, *shared, *setting, records).run_in_real_time();
}

bool replay(const mjModel *model, mjData *data, Shared *shared, const Setting *setting,
            Record *records, const int64_t *applied_ns) {
    return Episode(model, data, *shared, *setting, records).replay(applied_ns);
}

// The median difference of two readings of the clock, one after the other [ns].
int64_t clock_resolution_ns() {
    constexpr int COUNT = 1001;
    int64_t readings[COUNT + 1], differences[COUNT];
    for (int64_t &reading : readings) reading = read_clock_ns();
    for (int i = 0; i < COUNT; ++i) differences[i] = readings[i + 1] - readings[i];
    std::nth_element(differences, differences + COUNT / 2, differences + COUNT);
    return differences[COUNT / 2];
}
}
