#define BOOST_TEST_MODULE diptych
#include <boost/test/unit_test.hpp>
