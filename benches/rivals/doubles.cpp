/* Rivals that have 2F1 in doubles only: E_k and Var_k of strategy 2 by one 2F1 and formula 2.104. -DGSL takes GSL, else
   it is Boost.

     doubles version
     doubles points  K,K,...  D  JOBS     lines: point JOB K D SECONDS VALUE   (JOBS: of E and V; D is only repeated)

   Seconds are time by the clock of a call, best of several rounds. Where the library refuses there is no line. */
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#ifdef GSL
#include <gsl/gsl_errno.h>
#include <gsl/gsl_sf_hyperg.h>
#include <gsl/gsl_version.h>
static const char *version = GSL_VERSION;

static double hypergeometric(double l, double s, double z)
{
    gsl_sf_result result;
    if (gsl_sf_hyperg_2F1_e(1, l, s, z, &result))
        throw std::runtime_error("GSL refuses");
    return result.val;
}
#else
#include <boost/math/special_functions.hpp>
#include <boost/math/special_functions/hypergeometric_pFq.hpp>
#include <boost/version.hpp>
static const char *version = BOOST_LIB_VERSION;

static double hypergeometric(double l, double s, double z)
{
    return boost::math::hypergeometric_pFq({1.0, l}, {s}, z);
}
#endif

static double value(char job, unsigned long k)
{
    /* Photon k is the l-th of the m of its shell. */
    unsigned long shell = (unsigned long) std::floor((1 + std::sqrt(8.0 * (double) k - 7)) / 2);
    while (shell * (shell - 1) / 2 >= k) shell--;
    while (shell * (shell + 1) / 2 < k) shell++;
    double m = shell, inner = m * (m - 1) / 2, l = k - inner;
    double f = hypergeometric(l, m + 1, -2 / (m - 1));
    if (job == 'E')
        return f * k / inner;
    double square = (inner * m - (inner * (m - 1) + (l - 1) * m) * f) / (inner + m);
    return (square - f * f) * (k / inner) * (k / inner);
}

static double seconds()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

volatile double sink;

static double spent(long calls, char job, unsigned long k)
{
    double start = seconds();
    for (long i = 0; i < calls; i++)
        sink = value(job, k);
    return seconds() - start;
}

static void point(char job, const char *k, const char *digits)
{
    unsigned long photon = std::strtoul(k, nullptr, 10);
    long calls = 1;
    double best;
    while ((best = spent(calls, job, photon)) < 1e-3)
        calls *= 2;
    for (int round = 0; round < 6; round++)
        best = std::fmin(best, spent(calls, job, photon));
    std::printf("point %c %s %s %.4g %.16e\n", job, k, digits, best / calls, value(job, photon));
}

int main(int argc, char **argv)
{
#ifdef GSL
    gsl_set_error_handler_off();
#endif
    if (argc == 2 && !std::strcmp(argv[1], "version"))
        return std::puts(version) < 0;
    if (argc != 5 || std::strcmp(argv[1], "points"))
        return 2;
    for (char *k = std::strtok(argv[2], ","); k; k = std::strtok(nullptr, ","))
        for (const char *job = argv[4]; *job; job++)
            try
            {
                point(*job, k, argv[3]);
            }
            catch (const std::exception &error)
            {
                std::fprintf(stderr, "no value: %c %s %s\n", *job, k, error.what());
            }
}
