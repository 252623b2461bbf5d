// SPDX-License-Identifier: Apache-2.0
#include "base/folder_names.h"

enum { FIRST_SIZE = 4096, MAX_SIZE = 64 << 20, MAX_CALLS = 4 };

size_t names_list(struct arena *arena, names_fn *list, void *user_data, const char *from,
                  const char *folder, const char **out_names)
{
    size_t capacity = FIRST_SIZE;
    *out_names = "";
    for (int call = 0; call < MAX_CALLS && capacity <= MAX_SIZE; call++) {
        char *names = arena_alloc(arena, capacity + 1);
        size_t size = list(user_data, from, folder, names, capacity);
        if (size <= capacity) {
            names[size] = '\0'; /* the last name may lack it */
            *out_names = names;
            return size;
        }
        capacity = size;
    }
    return 0;
}
