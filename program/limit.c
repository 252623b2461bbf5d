// SPDX-License-Identifier: Apache-2.0
#define _DEFAULT_SOURCE
#include "program/limit.h"

#include <stdbool.h>
#include <stdio.h>
#include <sys/resource.h>
#include <unistd.h>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define HAS_ADDRESS_SANITIZER true
#endif
#endif
#if !defined(HAS_ADDRESS_SANITIZER) && defined(__SANITIZE_ADDRESS__)
#define HAS_ADDRESS_SANITIZER true
#elif !defined(HAS_ADDRESS_SANITIZER)
#define HAS_ADDRESS_SANITIZER false
#endif

uint64_t limit_of_file(uint64_t size)
{
    const uint64_t base = (uint64_t)256 << 20;
    return size > (UINT64_MAX - base) / 160 ? UINT64_MAX : base + 160 * size;
}

void limit_data(uint64_t bytes)
{
    static struct rlimit first;
    static bool is_known;
    if (HAS_ADDRESS_SANITIZER || (!is_known && getrlimit(RLIMIT_DATA, &first) != 0))
        return;
    is_known = true;
    struct rlimit limit = first;
    if (bytes < limit.rlim_cur)
        limit.rlim_cur = (rlim_t)bytes;
    setrlimit(RLIMIT_DATA, &limit);
}

uint64_t limit_data_used(void)
{
    unsigned long long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r"); /* proc(5): the sixth number */
    if (!file)
        return 0;
    if (fscanf(file, "%*u %*u %*u %*u %*u %llu", &pages) != 1)
        pages = 0;
    fclose(file);
    return pages * (uint64_t)sysconf(_SC_PAGESIZE);
}
