// SPDX-License-Identifier: Apache-2.0
/* suggest: the name that was probably meant. */
#include "diag/diag.h"

enum { MAX_WORD = 64 }; /* longer names are not compared */

/* A word to compare with many: of each byte, the places where it stands. */
struct pattern {
    size_t len; /* 1 to MAX_WORD */
    uint64_t places[256];
};

static void make_pattern(struct pattern *pattern, const char *word, size_t len)
{
    *pattern = (struct pattern){.len = len};
    for (size_t i = 0; i < len; i++)
        pattern->places[(unsigned char)word[i]] |= (uint64_t)1 << i;
}

/*
 * Edit distance where insertion, deletion, substitution and the swap of neighbours cost 1 ("optimal string alignment"): a row of the table
 * per character of `word`, as the differences between its columns, a bit each. Hyyrö, "A Bit-Vector Algorithm for Computing
 * Levenshtein and Damerau Edit Distances", Nordic Journal of Computing 10, 2003.
 */
static size_t edit_distance(const struct pattern *pattern, const char *word, size_t len)
{
    uint64_t more = UINT64_MAX, less = 0, same = 0, before = 0, last = (uint64_t)1 << (pattern->len - 1);
    size_t distance = pattern->len;
    for (size_t i = 0; i < len; i++) {
        uint64_t places = pattern->places[(unsigned char)word[i]], swapped = (~same & places) << 1 & before;
        same = (((places & more) + more) ^ more) | places | less | swapped; /* as far as diagonally before */
        uint64_t grows = less | ~(same | more), shrinks = same & more;      /* from the row above */
        distance += (grows & last) != 0;
        distance -= (shrinks & last) != 0;
        grows = grows << 1 | 1;
        more = shrinks << 1 | ~(same | grows);
        less = grows & same;
        before = places;
    }
    return distance;
}

/* MaterialX names are mostly lower case; a wrong case is a likely mistake. */
static void fold_case(char *out, const char *word, size_t len)
{
    for (size_t i = 0; i < len; i++)
        out[i] = (char)(word[i] >= 'A' && word[i] <= 'Z' ? word[i] - 'A' + 'a' : word[i]);
}

const char *diag_suggest(struct arena *arena, const char *word, const char *const *candidates, size_t num_candidates)
{
    char folded[MAX_WORD], other[MAX_WORD];
    size_t len = strlen(word);
    size_t best_distance = len / 3 + 1; /* one mistake per three letters, and one in a shorter word */
    const char *best = NULL;
    if (len < 2 || len > MAX_WORD)
        return "";
    if (best_distance < 2)
        best_distance = 2;
    fold_case(folded, word, len);
    struct pattern pattern;
    make_pattern(&pattern, folded, len);
    for (size_t i = 0; i < num_candidates; i++) {
        size_t other_len = strlen(candidates[i]);
        size_t difference = other_len > len ? other_len - len : len - other_len;
        if (other_len > MAX_WORD || difference >= best_distance)
            continue;
        fold_case(other, candidates[i], other_len);
        size_t distance = edit_distance(&pattern, other, other_len);
        if (distance < best_distance && (distance || strcmp(word, candidates[i]) != 0)) {
            best_distance = distance;
            best = candidates[i];
        }
    }
    if (!best)
        return "";
    struct text text;
    text_init(&text, arena);
    text_fmt(&text, " (did you mean '%s'?)", best);
    return text_cstr(&text);
}
