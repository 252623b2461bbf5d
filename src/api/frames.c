// SPDX-License-Identifier: Apache-2.0
/*
 * Files of image sequences (specification, "Filename Substitutions", and "Texture Node Notes" on
 * frame ranges).
 *
 *     {frame} {04frame}    the frame; the frame with leading zeros, four digits wide
 */
#include "api/generation.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>

/* Reads "10-99"; false: the sequence has no range. */
static bool read_range(const char *text, int64_t *out_first, int64_t *out_last)
{
    char *end;
    *out_first = strtol(text, &end, 10);
    if (end == text)
        return false;
    end += strspn(end, " ");
    const char *last = *end == '-' ? end + 1 : "";
    *out_last = strtol(last, &end, 10);
    return end != last && *out_first <= *out_last && *out_first >= INT32_MIN
           && *out_last <= INT32_MAX;
}

static int64_t modulo(int64_t a, int64_t b)
{
    return (a % b + b) % b;
}

/* Maps a frame to an image of the sequence. false: the frame has no image. */
static bool find_frame(const struct frame_sequence *sequence, int64_t *frame)
{
    int64_t first, last;
    *frame += sequence->offset;
    if (!read_range(sequence->range, &first, &last) || (*frame >= first && *frame <= last))
        return true;
    if (strcmp(sequence->end_action, "clamp") == 0) {
        *frame = *frame < first ? first : last;
    } else if (strcmp(sequence->end_action, "periodic") == 0) {
        *frame = first + modulo(*frame - first, last - first + 1);
    } else if (strcmp(sequence->end_action, "mirror") == 0) {
        int64_t span = last - first, at = span ? modulo(*frame - first, 2 * span) : 0;
        *frame = first + (at > span ? 2 * span - at : at);
    } else { /* end action "constant" */
        return false;
    }
    return true;
}

struct out { /* a buffer that keeps the first `capacity` bytes of a text */
    char *data;
    size_t capacity, len;
};

static void put(struct out *out, const char *text, size_t len)
{
    size_t room = out->capacity > out->len + 1 ? out->capacity - out->len - 1 : 0,
           kept = len < room ? len : room;
    if (kept) {
        memcpy(out->data + out->len, text, kept);
        out->data[out->len + kept] = '\0';
    }
    out->len += len;
}

/*
 * Reads "{frame}" or "{04frame}": returns the end of the token, and its minimum number of digits;
 * NULL: no token.
 */
static const char *read_token(const char *p, int *out_digits)
{
    const char *name = p + 1 + strspn(p + 1, "0123456789");
    *out_digits = p[1] == '0' && name - p == 3 ? p[2] - '0' : 0;
    bool is_frame = (name == p + 1 || *out_digits) && strncmp(name, "frame}", 6) == 0;
    return is_frame ? name + 6 : NULL;
}

size_t frame_file(const char *file, const struct frame_sequence *sequence, int32_t frame,
                  char *data, size_t capacity)
{
    struct out out = {data, data ? capacity : 0, 0};
    int64_t number = frame;
    if (!find_frame(sequence, &number))
        return 0;
    while (*file) {
        char digits[32];
        int width = 0;
        const char *end = *file == '{' ? read_token(file, &width) : NULL;
        if (end) {
            put(&out, digits,
                (size_t)snprintf(digits, sizeof digits, "%0*lld", width, (long long)number));
            file = end;
        } else {
            size_t plain = 1 + strcspn(file + 1, "{");
            put(&out, file, plain);
            file += plain;
        }
    }
    return out.len;
}
