#include "mpm/bar_run.hpp"

namespace diptych::mpm::bars {

template Record run(const Scene&, const std::vector<material::Hardening>&, int, const std::vector<double>&, Scheme,
                    const Stepping&);

}  // namespace diptych::mpm::bars
