/* E_k and Var_k of strategy 2 with C FLINT 3: one arb_hypgeom_2f1 a photon, at the least precision
   whose enclosure has the digits asked for (the start is a good guess; a retry costs what is missing).

     flint points  K,K,...  D,D,... [JOBS]     lines: point JOB K D SECONDS VALUE BITS   (JOB: E, V, or B for both)
     flint sweep   A B D                        both quantities of all photons A..B, one 2F1 each: sweep A B D COUNT
     flint version

   BITS is the relative accuracy proved. Seconds are time by the clock of a call, best of several rounds, fewer where
   a call is slow. The sweep is timed from outside. */
#include <flint/arb.h>
#include <flint/arb_hypgeom.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static arb_t one, argument, upper, lower, hypergeometric, mean, variance, scratch;

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
}

/* Photon k is the l-th of the m of its shell. */
static void place(ulong k, ulong *m, ulong *l)
{
    ulong s = (ulong) floor((1 + sqrt(8.0 * (double) k - 7)) / 2);
    while (s * (s - 1) / 2 >= k) s--;
    while (s * (s + 1) / 2 < k) s++;
    *m = s;
    *l = k - s * (s - 1) / 2;
}

/* F = 2F1(1, l; m+1; -2/(m-1)), E = k F/Va. */
static void evaluate_mean(ulong k, ulong m, ulong l, slong bits)
{
    arb_set_si(argument, -2);
    arb_div_ui(argument, argument, m - 1, bits);
    arb_set_ui(upper, l);
    arb_set_ui(lower, m + 1);
    arb_hypgeom_2f1(hypergeometric, one, upper, lower, argument, 0, bits);
    arb_mul_ui(mean, hypergeometric, k, bits);
    arb_div_ui(mean, mean, m * (m - 1) / 2, bits);
}

/* Formula 2.104: Var = (k/Va)^2 ((Va m - (Va (m-1) + (l-1) m) F)/(Va + m) - F^2). */
static void evaluate_variance(ulong k, ulong m, ulong l, slong bits)
{
    ulong inner = m * (m - 1) / 2;
    arb_set_ui(variance, inner);
    arb_mul_ui(variance, variance, m - 1, bits);
    arb_set_ui(scratch, l - 1);
    arb_mul_ui(scratch, scratch, m, bits);
    arb_add(variance, variance, scratch, bits);
    arb_mul(variance, variance, hypergeometric, bits);
    arb_set_ui(scratch, inner);
    arb_mul_ui(scratch, scratch, m, bits);
    arb_sub(variance, scratch, variance, bits);
    arb_div_ui(variance, variance, inner + m, bits);
    arb_mul(scratch, hypergeometric, hypergeometric, bits);
    arb_sub(variance, variance, scratch, bits);
    arb_set_ui(scratch, k);
    arb_div_ui(scratch, scratch, inner, bits);
    arb_mul(scratch, scratch, scratch, bits);
    arb_mul(variance, variance, scratch, bits);
}

/* The mean, the variance ('V') or both ('B') with `target` correct bits. */
static void certified(char job, ulong k, slong target)
{
    ulong m, l;
    place(k, &m, &l);
    /* 2.104 loses the bits of k^2. */
    slong bits = target + 20 + (job == 'E' ? 0 : (slong) (2 * log2((double) k)));
    for (;;)
    {
        evaluate_mean(k, m, l, bits);
        slong got = job == 'V' ? target : arb_rel_accuracy_bits(mean);
        if (job != 'E')
        {
            evaluate_variance(k, m, l, bits);
            slong other = arb_rel_accuracy_bits(variance);
            got = other < got ? other : got;
        }
        if (got >= target)
            return;
        bits += (target - (got > 0 ? got : 0)) + 16;
    }
}

static slong bits_of(long digits)
{
    return (slong) ceil(digits * 3.3219280948873626) + 1;
}

static void point(char job, ulong k, long digits)
{
    double best = 1e9, begin = seconds();
    for (int round = 0; round < 7 && (round == 0 || seconds() - begin < 0.5); round++)
    {
        long calls = 0;
        double start = seconds(), spent;
        do
        {
            certified(job, k, bits_of(digits));
            calls++;
            spent = seconds() - start;
        } while (spent < 0.002);
        if (spent / calls < best)
            best = spent / calls;
    }
    arb_srcptr value = job == 'E' ? mean : variance;
    char *text = arb_get_str(value, digits + 5, ARB_STR_NO_RADIUS);
    printf("point %c %lu %ld %.6g %s %ld\n", job, k, digits, best, text, (long) arb_rel_accuracy_bits(value));
    flint_free(text);
}

static void points(char *photons, const char *digits, const char *jobs)
{
    for (char *k = strtok(photons, ","); k; k = strtok(NULL, ","))
        for (const char *d = digits; *d;)
        {
            char *end;
            long count = strtol(d, &end, 10);
            for (const char *job = jobs; *job; job++)
                point(*job, strtoul(k, NULL, 10), count);
            d = *end == ',' ? end + 1 : end;
        }
}

int main(int argc, char **argv)
{
    arb_init(one);
    arb_one(one);
    arb_init(argument);
    arb_init(upper);
    arb_init(lower);
    arb_init(hypergeometric);
    arb_init(mean);
    arb_init(variance);
    arb_init(scratch);
    if ((argc == 4 || argc == 5) && !strcmp(argv[1], "points"))
        points(argv[2], argv[3], argc == 5 ? argv[4] : "EVB");
    else if (argc == 2 && !strcmp(argv[1], "version"))
        puts(FLINT_VERSION);
    else if (argc == 5 && !strcmp(argv[1], "sweep"))
    {
        ulong first = strtoul(argv[2], NULL, 10), last = strtoul(argv[3], NULL, 10);
        for (ulong k = first; k <= last; k++)
            certified('B', k, bits_of(atol(argv[4])));
        printf("sweep %lu %lu %s %lu\n", first, last, argv[4], last - first + 1);
    }
    else
    {
        fprintf(stderr, "usage: flint points K,K,... D,D,... [JOBS] | flint sweep A B D | flint version\n");
        return 2;
    }
    return 0;
}
