// SPDX-License-Identifier: Apache-2.0
/* Values of documents: every type's grammar on every text; numbers read and written. */
#include "fuzz.h"

#include "base/num.h"
#include "document/document.h"
#include "ir/ir.h"

/* A printed float reads back to itself. */
static void check_float(float value)
{
    char text[NUM_FLOAT_MAX];
    size_t len = num_print_float(text, value);
    float again;
    FUZZ_REQUIRE(len <= sizeof text);
    if (value == value && value - value == 0)
        FUZZ_REQUIRE(num_parse_float(text, len, &again) == len
                     && memcmp(&again, &value, sizeof value) == 0);
}

static void run(struct fuzz_job *job)
{
    struct strpool strings;
    struct ir_value value;
    strpool_init(&strings, &job->arena, NULL);
    for (doc_type type = DOC_TYPE_NONE + 1; type < DOC_NUM_TYPES; type++) {
        bool parsed = doc_parse_value(type, job->data, job->size, &strings, &value);
        FUZZ_REQUIRE(!parsed || doc_value_is_valid(type, job->data, job->size));
        if (parsed && type == DOC_TYPE_float)
            check_float(value.w[0].f);
    }
    int64_t integer;
    float number;
    FUZZ_REQUIRE(num_parse_int(job->data, job->size, &integer) <= job->size);
    FUZZ_REQUIRE(num_parse_float(job->data, job->size, &number) <= job->size);
    if (job->size >= sizeof number) {
        memcpy(&number, job->data, sizeof number);
        check_float(number);
    }
}

void fuzz_run(const char *data, size_t size, struct fuzz_heap *heap)
{
    fuzz_run_job(data, size, heap, 0, run);
}
