// SPDX-License-Identifier: Apache-2.0
/* The policy of -W: which warnings are shown, and which are errors. */
#include "diag/diag.h"

enum choice { UNSAID, NO, YES };

struct choices {
    bool all_errors;
    uint8_t told[DIAG_NUM_IDS], error[DIAG_NUM_IDS]; /* enum choice */
};

static bool skip(const char **word, size_t *len, const char *prefix)
{
    size_t n = strlen(prefix);
    if (*len < n || memcmp(*word, prefix, n) != 0)
        return false;
    *word += n;
    *len -= n;
    return true;
}

/* Errors cannot be disabled, and notes follow their diagnostic. */
static bool find_choosable(const char *word, size_t len, enum diag_id *out_id)
{
    if (!diag_id_find(word, len, out_id))
        return false;
    enum diag_severity severity = diag_id_severity(*out_id);
    return severity == DIAG_WARNING || severity == DIAG_REMARK;
}

static bool read_word(struct choices *choices, const char *word, size_t len)
{
    enum diag_id id;
    if (len == 5 && memcmp(word, "error", 5) == 0)
        return choices->all_errors = true;
    bool no = skip(&word, &len, "no-"), error = skip(&word, &len, "error=");
    if (!find_choosable(word, len, &id))
        return false;
    if (error)
        choices->error[id] = no ? NO : YES;
    if (!error || !no)
        choices->told[id] = no ? NO : YES;
    return true;
}

static enum diag_severity choose(const struct choices *choices, enum diag_id id)
{
    enum diag_severity severity = diag_id_severity(id);
    if (severity == DIAG_ERROR || severity == DIAG_NOTE)
        return severity;
    if (choices->told[id] == NO)
        return DIAG_IGNORED;
    if (severity == DIAG_REMARK && choices->told[id] == UNSAID)
        return DIAG_REMARK;
    bool is_error =
        choices->error[id] == YES || (choices->error[id] == UNSAID && choices->all_errors);
    return is_error ? DIAG_ERROR : DIAG_WARNING;
}

const char *diag_policy_parse(struct diag_policy *policy, const char *words)
{
    struct choices choices = {0};
    for (words += strspn(words, ", "); *words; words += strspn(words, ", ")) {
        size_t len = strcspn(words, ", ");
        if (!read_word(&choices, words, len))
            return words;
        words += len;
    }
    for (int id = 0; id < DIAG_NUM_IDS; id++)
        policy->severities[id] = (uint8_t)choose(&choices, (enum diag_id)id);
    return NULL;
}
