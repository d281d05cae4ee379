#include "mpm/plate_body.hpp"

namespace diptych::mpm {

template PlateRecord run_body<Standing, Whole>(const Setup&);
template PlateRecord run_body<Standing, Yielding>(const Setup&);

}  // namespace diptych::mpm
