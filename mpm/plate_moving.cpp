#include "mpm/plate_body.hpp"

namespace diptych::mpm {

template PlateRecord run_body<Moving, Whole>(const Setup&);
template PlateRecord run_body<Moving, Yielding>(const Setup&);

}  // namespace diptych::mpm
