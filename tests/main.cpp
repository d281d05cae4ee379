#define BOOST_TEST_MODULE diptych
#include <gsl/gsl_errno.h>

#include <boost/test/unit_test.hpp>

namespace {

/// As main() of the program does it.
struct QuietGsl {
  QuietGsl() { gsl_set_error_handler_off(); }
};

}  // namespace

BOOST_TEST_GLOBAL_FIXTURE(QuietGsl);
