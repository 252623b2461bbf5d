// SPDX-License-Identifier: Apache-2.0
/* Suggests the intended name for an unknown one. */
#include "diag/diag.h"

#include <assert.h>

enum {
    MAX_WORD = 64,    /* longer names are not compared */
    MAX_GUESSES = 64, /* per list */
};

static const struct diag_alias {
    const char *word, *name, *more;
} aliases[] = {
#define ALIAS(word, name) {word, name, ""},
#define ALIAS_WITH(word, name, more) {word, name, more},
#include "diag/aliases.def"
#undef ALIAS_WITH
#undef ALIAS
};

struct word {
    const char *text;
    size_t len;
};

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c | 0x20) : c;
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static size_t smaller(size_t a, size_t b)
{
    return a < b ? a : b;
}

/*
 * Edit distance with insertion, deletion, substitution and transposition of cost 1 ("optimal string
 * alignment"), row by row of its table; names are mostly lower case, so case does not count. Stops,
 * with a bound, at a row that has no distance below the best one.
 */
static size_t edit_distance(const struct diag_guess *guess, const char *word, size_t len)
{
    size_t rows[3][MAX_WORD + 1], least = 0;
    const char *other = guess->word;
    assert(guess->len <= MAX_WORD);
    for (size_t k = 0; k <= guess->len; k++)
        rows[0][k] = k;
    for (size_t i = 1; i <= len && least < guess->best_distance; i++) {
        size_t *row = rows[i % 3], *above = rows[(i + 2) % 3], *before = rows[(i + 1) % 3];
        least = row[0] = i;
        for (size_t k = 1; k <= guess->len; k++) {
            bool same = lower(word[i - 1]) == lower(other[k - 1]);
            row[k] = smaller(smaller(row[k - 1], above[k]) + 1, above[k - 1] + !same);
            if (i > 1 && k > 1 && lower(word[i - 1]) == lower(other[k - 2])
                && lower(word[i - 2]) == lower(other[k - 1]))
                row[k] = smaller(row[k], before[k - 2] + 1);
            least = smaller(least, row[k]);
        }
    }
    return least < guess->best_distance ? rows[len % 3][guess->len] : least;
}

/* ---- Words of a name ---- */

/* The next word of a name with words joined by '_'; moves *at behind it. Length 0: none is left. */
static struct word next_word(const char *name, size_t len, size_t *at)
{
    size_t start = *at, end = start;
    while (end < len && name[end] != '_')
        end++;
    *at = end + (end < len);
    return (struct word){name + start, end - start};
}

static bool is_same_word(struct word a, struct word b)
{
    bool same = a.len == b.len;
    for (size_t i = 0; same && i < a.len; i++)
        same = lower(a.text[i]) == lower(b.text[i]);
    return same;
}

static size_t count_words(const char *name, size_t len)
{
    size_t count = 1;
    for (size_t i = 0; i < len; i++)
        count += name[i] == '_';
    return count;
}

/* True if all words of `few` occur in `many`, in the same order. */
static bool has_words(const char *many, size_t many_len, const char *few, size_t few_len)
{
    size_t at = 0;
    for (size_t next = 0; next < few_len;) {
        struct word wanted = next_word(few, few_len, &next), word;
        do
            word = next_word(many, many_len, &at);
        while (!is_same_word(word, wanted) && at < many_len);
        if (!is_same_word(word, wanted))
            return false;
    }
    return true;
}

/* True if `name` consists of the whole `start`, a '_' and more. */
static bool extends(const char *name, size_t len, const char *start, size_t start_len)
{
    return len > start_len && name[start_len] == '_'
           && is_same_word((struct word){name, start_len}, (struct word){start, start_len});
}

/* ---- Candidates ---- */

/*
 * Smaller is better: an alias, then a misspelling (its distance), then a name that begins with the
 * word, then a name that has the same words and others.
 */
enum { SCORE_ALIAS = 0, SCORE_BEGINS = 1000, SCORE_HAS_WORDS = 2000, SCORE_NONE = 3000 };

enum { MIN_WORD = 4 }; /* shorter words occur in too many names */

/* The name without the number at its end. */
static struct word stem_of(const char *name, size_t len)
{
    while (len && is_digit(name[len - 1]))
        len--;
    return (struct word){name, len};
}

/*
 * Names that end with different numbers ("n1", "n2") are different on purpose, and in two letters
 * no one recognises a misspelling.
 */
static bool differs_on_purpose(const struct diag_guess *guess, const char *candidate, size_t len)
{
    const char *a = guess->word, *b = candidate;
    if (guess->len == 2 && len == 2)
        return !(lower(a[0]) == lower(b[1]) && lower(a[1]) == lower(b[0]));
    struct word left = stem_of(a, guess->len), right = stem_of(b, len);
    return left.len < guess->len && right.len < len && is_same_word(left, right);
}

/* A misspelling changes a word a little; a name with another word is another name. */
static bool is_misspelling(const struct diag_guess *guess, const char *candidate, size_t len,
                           size_t distance)
{
    if (distance && differs_on_purpose(guess, candidate, len))
        return false;
    if (count_words(candidate, len) != count_words(guess->word, guess->len))
        return true;
    for (size_t at = 0, from = 0; at < guess->len && from < len;) {
        struct word a = next_word(guess->word, guess->len, &at),
                    b = next_word(candidate, len, &from);
        size_t longer = a.len > b.len ? a.len : b.len;
        if (distance > 1 && distance > longer / 2 && !is_same_word(a, b))
            return false;
    }
    return true;
}

void diag_list_init_unheard(struct diag_list *list, struct arena *arena)
{
    diag_list_init(list, arena);
    list->num_guesses = MAX_GUESSES;
}

bool diag_may_guess(const struct diag_list *list)
{
    return list->num_guesses < MAX_GUESSES;
}

static void find_aliases(struct diag_guess *guess)
{
    struct word word = {guess->word, guess->len};
    size_t count = 0;
    for (size_t i = 0; i < sizeof aliases / sizeof *aliases; i++)
        if (is_same_word(word, (struct word){aliases[i].word, strlen(aliases[i].word)})
            && count < DIAG_MAX_ALIASES)
            guess->aliases[count++] = &aliases[i];
}

bool diag_guess_begin(struct diag_guess *guess, struct diag_list *list, const char *word)
{
    /* one per three letters, at least one */
    size_t len = strlen(word), mistakes = len / 3;
    *guess = (struct diag_guess){.list = list,
                                 .word = word,
                                 .best_distance = mistakes ? mistakes + 1 : 2,
                                 .best_score = SCORE_NONE};
    if (!diag_may_guess(list))
        return false;
    list->num_guesses++; /* also for words without a suggestion: their callers walk, too */
    if (!len || len > MAX_WORD)
        return false;
    guess->len = len;
    find_aliases(guess);
    if (len == 1)
        guess->best_distance = 0; /* any other letter is near */
    return true;
}

/* The alias of the word that is a candidate; NULL: there is none. */
static const struct diag_alias *alias_of(const struct diag_guess *guess, const char *candidate)
{
    for (size_t i = 0; i < DIAG_MAX_ALIASES && guess->aliases[i]; i++)
        if (strcmp(guess->aliases[i]->name, candidate) == 0)
            return guess->aliases[i];
    return NULL;
}

static size_t score_of_misspelling(struct diag_guess *guess, const char *candidate, size_t len)
{
    size_t difference = len > guess->len ? len - guess->len : guess->len - len;
    if (difference >= guess->best_distance)
        return SCORE_NONE;
    assert(len <= MAX_WORD && guess->len + guess->best_distance > len);
    size_t distance = edit_distance(guess, candidate, len);
    if (distance >= guess->best_distance || !is_misspelling(guess, candidate, len, distance))
        return SCORE_NONE;
    guess->best_distance = distance;
    return SCORE_ALIAS + 1 + distance;
}

/* For a name that is longer or shorter than the word by whole words. */
static size_t score_of_words(const struct diag_guess *guess, const char *candidate, size_t len)
{
    size_t shorter = len < guess->len ? len : guess->len,
           difference = len > guess->len ? len - guess->len : guess->len - len;
    if (shorter < MIN_WORD || difference == 0)
        return SCORE_NONE;
    if (extends(candidate, len, guess->word, guess->len)
        || extends(guess->word, guess->len, candidate, len))
        return SCORE_BEGINS + difference;
    bool has_several = memchr(guess->word, '_', guess->len) != NULL;
    return has_several && len > guess->len && has_words(candidate, len, guess->word, guess->len)
               ? SCORE_HAS_WORDS + difference
               : SCORE_NONE;
}

void diag_guess_add(struct diag_guess *guess, const char *candidate)
{
    size_t len = strlen(candidate);
    if (!guess->len || len < 2 || len > MAX_WORD || strcmp(guess->word, candidate) == 0)
        return;
    size_t score =
        alias_of(guess, candidate) ? SCORE_ALIAS : score_of_misspelling(guess, candidate, len);
    if (score == SCORE_NONE)
        score = score_of_words(guess, candidate, len);
    if (score < guess->best_score) {
        guess->best_score = score;
        guess->best = candidate;
    }
}

const char *diag_guess_text(struct diag_guess *guess)
{
    if (!guess->best)
        return "";
    struct text text;
    text_init(&text, guess->list->arena);
    const struct diag_alias *alias = alias_of(guess, guess->best);
    text_fmt(&text, " (did you mean '%s'?)%s", guess->best, alias ? alias->more : "");
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
