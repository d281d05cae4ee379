#include "mpm/plate_body.hpp"

namespace diptych::mpm {

template PlateRecord run_body<Standing, Cracked>(const Setup&);
template PlateRecord run_body<Standing, CrackedYielding>(const Setup&);

}  // namespace diptych::mpm
