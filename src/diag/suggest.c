// SPDX-License-Identifier: Apache-2.0
/* Suggests the intended name for an unknown one. */
#include "diag/diag.h"

#include <assert.h>

enum {
    MAX_WORD = 64,    /* longer names are not compared: each position is a bit */
    MAX_GUESSES = 64, /* per list */
};

/*
 * Edit distance with insertion, deletion, substitution and transposition of cost 1 ("optimal string
 * alignment"). The algorithm keeps a row of the table as differences between columns, one bit each:
 * Hyyrö, "A Bit-Vector Algorithm for Computing Levenshtein and Damerau Edit Distances", Nordic
 * Journal of Computing 10, 2003. Each further character changes the distance by at most 1, so the
 * loop stops when a candidate cannot become better than the best one.
 */
static size_t edit_distance(const struct diag_guess *guess, const char *word, size_t len)
{
    assert(guess->len > 0 && guess->len <= MAX_WORD);
    uint64_t more = UINT64_MAX, less = 0, same = 0, before = 0,
             last = (uint64_t)1 << (guess->len - 1);
    size_t distance = guess->len;
    for (size_t i = 0; i < len && distance < guess->best_distance + (len - i); i++) {
        uint64_t places = guess->places[(unsigned char)word[i]],
                 swapped = (~same & places) << 1 & before;
        /* equal to the diagonal value */
        same = (((places & more) + more) ^ more) | places | less | swapped;
        /* relative to the row above */
        uint64_t grows = less | ~(same | more), shrinks = same & more;
        distance += (grows & last) != 0;
        distance -= (shrinks & last) != 0;
        grows = grows << 1 | 1;
        more = shrinks << 1 | ~(same | grows);
        less = grows & same;
        before = places;
    }
    assert(distance <= guess->len + len);
    return distance;
}

/* MaterialX names are mostly lower case, so the comparison ignores case. */
static void add_place(struct diag_guess *guess, unsigned char c, size_t place)
{
    assert(place < MAX_WORD);
    unsigned char lower = c | 0x20;
    guess->places[c] |= (uint64_t)1 << place;
    if (lower >= 'a' && lower <= 'z')
        guess->places[c ^ 0x20] |= (uint64_t)1 << place;
}

bool diag_may_guess(const struct diag_list *list)
{
    return list->num_guesses < MAX_GUESSES;
}

bool diag_guess_begin(struct diag_guess *guess, struct diag_list *list, const char *word)
{
    /* one per three letters, at least one */
    size_t len = strlen(word), mistakes = len / 3;
    *guess = (struct diag_guess){
        .list = list, .word = word, .best_distance = mistakes ? mistakes + 1 : 2};
    if (len < 2 || len > MAX_WORD || !diag_may_guess(list))
        return false;
    list->num_guesses++;
    guess->len = len;
    for (size_t i = 0; i < len; i++)
        add_place(guess, (unsigned char)word[i], i);
    return true;
}

void diag_guess_add(struct diag_guess *guess, const char *candidate)
{
    size_t len = strlen(candidate),
           difference = len > guess->len ? len - guess->len : guess->len - len;
    if (!guess->len || len > MAX_WORD || difference >= guess->best_distance)
        return;
    assert(len <= MAX_WORD && guess->len + guess->best_distance > len);
    size_t distance = edit_distance(guess, candidate, len);
    if (distance < guess->best_distance && (distance || strcmp(guess->word, candidate) != 0)) {
        guess->best_distance = distance;
        guess->best = candidate;
    }
}

const char *diag_guess_text(struct diag_guess *guess)
{
    if (!guess->best)
        return "";
    struct text text;
    text_init(&text, guess->list->arena);
    text_fmt(&text, " (did you mean '%s'?)", guess->best);
    return text_cstr(&text);
}

const char *diag_suggest(struct diag_list *list, const char *word, const char *const *candidates,
                         size_t num_candidates)
{
    struct diag_guess guess;
    bool may_guess = diag_guess_begin(&guess, list, word);
    for (size_t i = 0; may_guess && i < num_candidates; i++)
        diag_guess_add(&guess, candidates[i]);
    return diag_guess_text(&guess);
}
