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
 * one row of the table per character of `a`, of which three are kept. `limit` where it is that or more, which two rows in a
 * row tell: no swap leads past both.
 */
static size_t edit_distance(const char *a, size_t a_len, const char *b, size_t b_len, size_t limit)
{
    size_t rows[3][MAX_WORD + 1], least_above = 0;
    for (size_t j = 0; j <= b_len; j++)
        rows[0][j] = j;
    for (size_t i = 1; i <= a_len; i++) {
        const size_t *before = rows[(i + 1) % 3], *above = rows[(i - 1) % 3];
        size_t *row = rows[i % 3], least_here = row[0] = i;
        for (size_t j = 1; j <= b_len; j++) {
            row[j] = least(least(above[j], row[j - 1]) + 1, above[j - 1] + (a[i - 1] != b[j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = least(row[j], before[j - 2] + 1);
            least_here = least(least_here, row[j]);
        }
        if (least_here >= limit && least_above >= limit)
            return limit;
        least_above = least_here;
    }
    return rows[a_len % 3][b_len];
}

struct word {
    char folded[MAX_WORD]; /* MaterialX names are mostly lower case; a wrong case is a likely mistake */
    size_t len;
};

static void read_word(struct word *word, const char *text)
{
    word->len = strlen(text);
    for (size_t i = 0; i < word->len && i < MAX_WORD; i++)
        word->folded[i] = (char)(text[i] >= 'A' && text[i] <= 'Z' ? text[i] - 'A' + 'a' : text[i]);
}

enum { NUM_BAGS = 32 };

static size_t bag_of(char c)
{
    return (unsigned char)c % NUM_BAGS;
}

/*
 * Whether two words may be nearer than `limit`: what one has more of than the other, in any order, takes a change for each. `bags`
 * tell how often the first word has each character, some of which are taken for the same.
 */
static bool may_be_near(const unsigned char bags[NUM_BAGS], const struct word *a, const struct word *b, size_t limit)
{
    unsigned char left[NUM_BAGS];
    size_t longer = a->len > b->len ? a->len : b->len, shared = 0;
    if (b->len > MAX_WORD || longer - least(a->len, b->len) >= limit)
        return false;
    memcpy(left, bags, sizeof left);
    for (size_t i = 0; i < b->len; i++) {
        unsigned char *bag = &left[bag_of(b->folded[i])];
        shared += *bag > 0;
        *bag = (unsigned char)(*bag - (*bag > 0));
    }
    return longer - shared < limit;
}

const char *diag_suggest(struct arena *arena, const char *word, const char *const *candidates, size_t num_candidates)
{
    struct word wrong, other;
    unsigned char bags[NUM_BAGS] = {0};
    read_word(&wrong, word);
    size_t best_distance = wrong.len / 3 + 1; /* one mistake per three letters, and one in a shorter word */
    const char *best = NULL;
    if (wrong.len < 2 || wrong.len > MAX_WORD)
        return "";
    if (best_distance < 2)
        best_distance = 2;
    for (size_t i = 0; i < wrong.len; i++)
        bags[bag_of(wrong.folded[i])]++;
    for (size_t i = 0; i < num_candidates; i++) {
        read_word(&other, candidates[i]);
        if (!may_be_near(bags, &wrong, &other, best_distance) || strcmp(word, candidates[i]) == 0)
            continue;
        size_t distance = edit_distance(wrong.folded, wrong.len, other.folded, other.len, best_distance);
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
