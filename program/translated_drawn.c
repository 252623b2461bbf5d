// SPDX-License-Identifier: Apache-2.0
#include "program/drawn.h"
#include "program/translated.h"

#include <stdlib.h>
#include <string.h>

/* Three views of a ball; the last has lights without an environment. */
enum { NUM_VIEWS = 3, NUM_VIEW_OPTIONS = 4 };
static const char *const views[NUM_VIEWS][NUM_VIEW_OPTIONS] = {
    {"--size=64", "--mesh=sphere", "--camera=25,16"},
    {"--size=64", "--mesh=sphere", "--camera=150,45"},
    {"--size=64", "--mesh=sphere", "--camera=-70,5", "--environment=none"},
};

double translated_difference(struct cli *cli, const char *path, const char *element,
                             const char *model, const char *folder, char **out_fault)
{
    char *translate = cli_format("--translate=%s", model);
    double sum = 0;
    for (size_t i = 0; i < NUM_VIEWS && sum >= 0; ++i) {
        const char *old[NUM_VIEW_OPTIONS + 1] = {0}, *new[NUM_VIEW_OPTIONS + 2] = {translate};
        memcpy(old, views[i], sizeof views[i]);
        memcpy(new + 1, views[i], sizeof views[i]);
        struct drawn_subject one = {
            .cli = cli, .file = path, .element = element, .look = old, .folder = folder};
        struct drawn_subject other = one;
        other.look = new;
        double error = drawn_difference(&one, &other, out_fault);
        sum = error < 0 ? error : sum + error;
    }
    free(translate);
    return sum < 0 ? sum : sum / NUM_VIEWS;
}
