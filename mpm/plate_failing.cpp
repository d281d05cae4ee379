#include "mpm/plate_body.hpp"

namespace diptych::mpm {

template PlateRecord run_body<Standing, Failing>(const Setup&);

}  // namespace diptych::mpm
