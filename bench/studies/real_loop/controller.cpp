// A Cartesian controller in a process of its own: torques for the newest state that the plant writes to shared memory.
//
//   a = (Kp (p_d - p) - Kv pdot, u) - Jdot qdot     u by the exported law LAW, its header HEADER, gains of the plant
//   tau = D J^+ a + h                               D, h (gravity, Coriolis, damping), J and Jdot by MuJoCo
//
// On seven joints the joint rates that the tool does not see are damped by -Kv/2 qdot, as in the benchmark's loop.
// Call: controller MODEL.mjb SHARED-FILE. It ends when the plant writes a negative tick.
#include <fcntl.h>
#include <semaphore.h>
#include <sys/mman.h>
#include <unistd.h>

#include <Eigen/Dense>
#include <atomic>

#include <mujoco/mujoco.h>

#include HEADER

namespace law = orientation_bench::LAW;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Vector = Eigen::VectorXd;

// plant.py has the same fields in the same order
struct Shared {
    double q[2][7], qdot[2][7];  // of ticks with an even and with an odd number
    double R_d[9], p_d[3], kp, kv;
    double tau[2][7];
    std::atomic<long> tick;      // newest state, counted from 1 in each episode; 0: none yet
    std::atomic<long> answered;  // newest state whose torques are there
    sem_t is_new;
};

int main(int, char **words) {
    const mjModel *model = mj_loadModel(words[1], nullptr);
    mjData *data = mj_makeData(model);
    const int n = model->nv, site = mj_name2id(model, mjOBJ_SITE, "tool"), body = model->site_bodyid[site];
    const int file = open(words[2], O_RDWR);
    Shared &shared = *static_cast<Shared *>(
        mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0));
    Matrix J(6, n), J_dot(6, n), D(n, n);
    Vector a(6), tau(n);
#ifdef HAS_MEMORY
    law::State memory;
#endif
    long before = 0;
    for (;;) {
        sem_wait(&shared.is_new);
        const long tick = shared.tick.load();
        if (tick < 0) return 0;
        if (tick == before) continue;  // answered already: the plant was ahead by more than a tick
#ifdef HAS_MEMORY
        if (tick < before) memory.reset();
#endif
        before = tick;
        mju_copy(data->qpos, shared.q[tick & 1], n);
        mju_copy(data->qvel, shared.qdot[tick & 1], n);
        mj_fwdPosition(model, data);
        mj_fwdVelocity(model, data);
        mj_jacSite(model, data, J.data(), J.data() + 3 * n, site);
        mj_jacDot(model, data, J_dot.data(), J_dot.data() + 3 * n, data->site_xpos + 3 * site, body);
        mj_fullM(model, data, D.data());
        const Eigen::Map<const Vector> qdot(data->qvel, n), bias(data->qfrc_bias, n), passive(data->qfrc_passive, n);
        const Eigen::Map<const Eigen::Vector3d> p(data->site_xpos + 3 * site), p_d(shared.p_d);
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
        const Vector x = J.completeOrthogonalDecomposition().solve(a + damping * twist) - damping * qdot;
        tau = D * x + bias - passive;
        mju_copy(shared.tau[tick & 1], tau.data(), n);
        shared.answered.store(tick);
    }
}
