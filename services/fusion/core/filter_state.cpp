#include "fusion/core/filter_state.hpp"

#include "core/rotation.hpp"
#include "core/square.hpp"

namespace vpdr::fusion {

bool correct(const Innovation& innovation, double gate_sigmas, InnovationCounters& counters,
             FilterState& state) {
  const StateVector ph = state.p * innovation.row;
  const double s = innovation.row.dot(ph) + innovation.variance;
  const double nis = square(innovation.value) / s;
  if (nis > square(gate_sigmas)) {
    ++counters.gated;
    return false;
  }
  state.x += ph * (innovation.value / s);
  state.p.noalias() -= ph * (ph.transpose() / s);
  state.x[kYaw] = wrap_pi(state.x[kYaw]);
  counters.nis_sum += nis;
  ++counters.accepted;
  return true;
}

void replace_by_copy(StateIndex to, StateIndex from, double sign, double added_variance,
                     FilterState& state) {
  state.p.row(to) = sign * state.p.row(from);
  state.p.col(to) = state.p.row(to).transpose();
  state.p(to, to) = state.p(from, from) + added_variance;
}

void make_independent(StateIndex index, double variance, FilterState& state) {
  state.p.row(index).setZero();
  state.p.col(index).setZero();
  state.p(index, index) = variance;
}

}  // namespace vpdr::fusion
