// SPDX-License-Identifier: Apache-2.0
/* suggest: the name that was probably meant. */
#include "diag/diag.h"

enum { MAX_WORD = 64 }; /* longer names are not compared */

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/*
 * Edit distance where insertion, deletion, substitution and the swap of neighbours cost 1 ("optimal string alignment"):
 * one row of the table per character of `a`, of which three are kept.
 */
static size_t edit_distance(const char *a, size_t a_len, const char *b, size_t b_len)
{
    size_t rows[3][MAX_WORD + 1];
    for (size_t j = 0; j <= b_len; j++)
        rows[0][j] = j;
    for (size_t i = 1; i <= a_len; i++) {
        const size_t *before = rows[(i + 1) % 3], *above = rows[(i - 1) % 3];
        size_t *row = rows[i % 3];
        row[0] = i;
        for (size_t j = 1; j <= b_len; j++) {
            row[j] = least(least(above[j], row[j - 1]) + 1, above[j - 1] + (a[i - 1] != b[j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = least(row[j], before[j - 2] + 1);
        }
    }
    return rows[a_len % 3][b_len];
}

/* MaterialX names are mostly lower case; a wrong case is a likely mistake. */
static size_t fold_case(char *out, const char *word)
{
    size_t len = strlen(word);
    for (size_t i = 0; i < len && i < MAX_WORD; i++)
        out[i] = (char)(word[i] >= 'A' && word[i] <= 'Z' ? word[i] - 'A' + 'a' : word[i]);
    return len;
}

const char *diag_suggest(struct arena *arena, const char *word, const char *const *candidates, size_t num_candidates)
{
    char folded[MAX_WORD], other[MAX_WORD];
    size_t len = fold_case(folded, word);
    size_t best_distance = len / 3 + 1; /* one mistake per three letters, and one in a shorter word */
    const char *best = NULL;
    if (len < 2 || len > MAX_WORD)
        return "";
    if (best_distance < 2)
        best_distance = 2;
    for (size_t i = 0; i < num_candidates; i++) {
        size_t other_len = fold_case(other, candidates[i]);
        size_t difference = other_len > len ? other_len - len : len - other_len;
        if (other_len > MAX_WORD || difference >= best_distance || strcmp(word, candidates[i]) == 0)
            continue;
        size_t distance = edit_distance(folded, len, other, other_len);
        if (distance < best_distance) {
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
