// What the arm's process and the controller's process share. loop.py has the same fields in the
// same order.
#pragma once
#include <semaphore.h>
#include <time.h>

#include <atomic>
#include <cstdint>

constexpr int MOST_JOINTS = 7;
// Old entries stay for 64 periods, so that neither process reads what the other one overwrites.
constexpr int SLOTS = 64;

struct State {
    double q[MOST_JOINTS], qdot[MOST_JOINTS];
};

struct Answer {
    int64_t tick;                 // of the state that it answers
    int64_t read_ns, written_ns;  // when the controller read the state, and had written the torques
    double tau[MOST_JOINTS];
};

struct Shared {
    State states[SLOTS];    // the state of tick t is in slot t % SLOTS
    Answer answers[SLOTS];  // the answer with number i is in slot i % SLOTS
    double R_d[9], p_d[3], kp, kv;
    int64_t episode;
    // Of the newest state, from 1 in each episode; 0: none yet; negative: the end.
    std::atomic<int64_t> tick;
    // Number of the newest answer, from 1 in each episode; 0: none yet.
    std::atomic<int64_t> answered;
    sem_t is_new;
};

// Both processes read this clock of the system, so that their readings can be subtracted.
inline int64_t read_clock_ns() {
    timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return 1'000'000'000 * int64_t(now.tv_sec) + now.tv_nsec;
}
