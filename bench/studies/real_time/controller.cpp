// A Cartesian controller in a process of its own: torques for the newest state that the arm writes
// to shared memory.
//
//   a = (Kp (p_d - p) - Kv pdot, u) - Jdot qdot     u by the exported law LAW, its header HEADER
//   tau = D J^+ a + h                          D, h (gravity, Coriolis, damping), J and Jdot by MuJoCo
//
// On seven joints the joint rates that the tool does not see are damped by -Kv/2 qdot, as in the
// benchmark's loop. Call: controller MODEL.mjb SHARED-FILE. It ends when the arm's process writes a
// negative tick.
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <Eigen/Dense>

#include <mujoco/mujoco.h>

#include "shared.hpp"
#include HEADER

namespace law = orientation_bench::LAW;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Vector = Eigen::VectorXd;

constexpr int PROT = PROT_READ | PROT_WRITE;

int main(int, char **words) {
    const mjModel *model = mj_loadModel(words[1], nullptr);
    mjData *data = mj_makeData(model);
    const int n = model->nv;
    const int site = mj_name2id(model, mjOBJ_SITE, "tool"), body = model->site_bodyid[site];
    const int file = open(words[2], O_RDWR);
    Shared &shared =
        *static_cast<Shared *>(mmap(nullptr, sizeof(Shared), PROT, MAP_SHARED, file, 0));
    Matrix J(6, n), J_dot(6, n), D(n, n);
    Vector a(6), tau(n);
#ifdef HAS_MEMORY
    law::State memory;
#endif
    int64_t tick_before = 0, episode = 0;
    for (;;) {
        sem_wait(&shared.is_new);
        int64_t tick, read_ns;
        do {
            tick = shared.tick.load(std::memory_order_acquire);
            if (tick < 0) return 0;
            const State &state = shared.states[tick % SLOTS];
            mju_copy(data->qpos, state.q, n);
            mju_copy(data->qvel, state.qdot, n);
            read_ns = read_clock_ns();
            // If this process slept while it copied, the arm may have come round to the same slot.
        } while (shared.tick.load(std::memory_order_acquire) - tick >= SLOTS - 1);
        // The arm was ahead by more than a tick when this state was read: the semaphore counts
        // states, not answers.
        if (tick == tick_before && episode == shared.episode) continue;
        if (tick == 0) continue;
        if (episode != shared.episode) {
            episode = shared.episode;
#ifdef HAS_MEMORY
            memory.reset();
#endif
        }
        tick_before = tick;
        mj_fwdPosition(model, data);
        mj_fwdVelocity(model, data);
        mj_jacSite(model, data, J.data(), J.data() + 3 * n, site);
        const double *point = data->site_xpos + 3 * site;
        mj_jacDot(model, data, J_dot.data(), J_dot.data() + 3 * n, point, body);
        mj_fullM(model, data, D.data());
        const Eigen::Map<const Vector> qdot(data->qvel, n);
        const Eigen::Map<const Vector> bias(data->qfrc_bias, n), passive(data->qfrc_passive, n);
        const Eigen::Map<const Eigen::Vector3d> p(point), p_d(shared.p_d);
        const Eigen::Map<const law::Rows> R(data->site_xmat + 9 * site), R_d(shared.R_d);
        const double kp = shared.kp, kv = shared.kv;
        const Vector twist = J * qdot;
        a.head<3>() = kp * (p_d - p) - kv * twist.head<3>();
#ifdef HAS_MEMORY
        a.tail<3>() = law::angular_acceleration(R, twist.tail<3>(), R_d, kp, kv, memory);
#else
        a.tail<3>() = law::angular_acceleration(R, twist.tail<3>(), R_d, kp, kv);
#endif
        a -= J_dot * qdot;
        const double damping = n > 6 ? 0.5 * kv : 0.0;
        const Vector wanted = J.completeOrthogonalDecomposition().solve(a + damping * twist);
        tau = D * (wanted - damping * qdot) + bias - passive;
        const int64_t number = shared.answered.load() + 1;
        Answer &answer = shared.answers[number % SLOTS];
        answer.tick = tick;
        answer.read_ns = read_ns;
        mju_copy(answer.tau, tau.data(), n);
        answer.written_ns = read_clock_ns();
        shared.answered.store(number, std::memory_order_release);
    }
}
