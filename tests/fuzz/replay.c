// SPDX-License-Identifier: Apache-2.0
/*
 * Feeds files to a fuzz target, for compilers without libFuzzer: the inputs that ever failed, and
 * the seeds. Arguments: files, folders.
 */
#define _POSIX_C_SOURCE 200809L
#include "fuzz.h"

#include <dirent.h>
#include <string.h>
#include <sys/stat.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static unsigned num_passed;

static void feed_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    FUZZ_REQUIRE(file && fseek(file, 0, SEEK_END) == 0);
    size_t size = (size_t)ftell(file);
    rewind(file);
    uint8_t *data = malloc(size ? size : 1); /* no byte more, so that reading beyond is seen */
    FUZZ_REQUIRE(data && fread(data, 1, size, file) == size);
    fclose(file);
    fprintf(stderr, "%s\n", path); /* the last one is at fault */
    LLVMFuzzerTestOneInput(data, size);
    free(data);
    ++num_passed;
}

static void feed(const char *path)
{
    struct stat info;
    FUZZ_REQUIRE(stat(path, &info) == 0);
    if (!S_ISDIR(info.st_mode)) {
        feed_file(path);
        return;
    }
    struct dirent **entries;
    int count = scandir(path, &entries, NULL, alphasort);
    FUZZ_REQUIRE(count >= 0);
    for (int i = 0; i < count; ++i) {
        char inner[4096];
        snprintf(inner, sizeof inner, "%s/%s", path, entries[i]->d_name);
        if (entries[i]->d_name[0] != '.')
            feed(inner);
        free(entries[i]);
    }
    free(entries);
}

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; ++i)
        feed(argv[i]);
    printf("fuzz-replay: %u passed, 0 failed\n", num_passed);
    return num_passed ? 0 : 77;
}
