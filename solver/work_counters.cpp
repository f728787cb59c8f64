#include "solver/work_counters.h"

namespace wishbone {

std::vector<std::pair<std::string, long>> named_counts(const WorkCounters& work) {
  return {{"position_sweeps", work.position},
          {"velocity_sweeps", work.velocity},
          {"force_evaluations", work.forces},
          {"signal_evaluations", work.signals},
          {"drive_evaluations", work.drives},
          {"inertia_factorizations", work.inertia},
          {"acceleration_solves", work.solves},
          {"inverse_dynamics", work.inverse_dynamics},
          {"jacobians", work.tangents},
          {"closure_factorizations", work.closure_factorizations},
          {"orthogonal_factorizations", work.orthogonal_factorizations},
          {"projections", work.projections},
          {"rank_searches", work.rank_searches},
          {"rank_revisions", work.rank_revisions},
          {"partitions", work.partitions}};
}

}  // namespace wishbone
