// The only file that uses Boost.Math.
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>

extern "C" {
#include "golden/student.h"
}

namespace
{

// Out-of-range arguments give a number, never an exception.
using Policy = boost::math::policies::policy<
    boost::math::policies::domain_error<boost::math::policies::ignore_error>,
    boost::math::policies::overflow_error<boost::math::policies::ignore_error>,
    boost::math::policies::evaluation_error<boost::math::policies::ignore_error>>;

} // namespace

extern "C" double student_two_sided(double t, double freedom)
{
    boost::math::students_t_distribution<double, Policy> distribution(freedom);
    return 2.0 * boost::math::cdf(boost::math::complement(distribution, std::fabs(t)));
}

extern "C" double normal_of_two_sided(double p)
{
    boost::math::normal_distribution<double, Policy> distribution;
    double half = std::clamp(0.5 * p, 1e-300, 0.5);
    return boost::math::quantile(boost::math::complement(distribution, half));
}
