// SPDX-License-Identifier: Apache-2.0
#include "render/unwrap.h"

#include "program/cli.h"

#include <string.h>

char *unwrap_stage(const char *source, uint32_t location)
{
    static const char begin[] = "gl_Position = ", main[] = "void main()";
    const char *head = strstr(source, main), *place = head ? strstr(head, begin) : NULL;
    const char *end = place ? strchr(place, ';') : NULL;
    if (!end)
        return NULL;
    return cli_format("%.*slayout(location = %u) in vec2 i_unwrapped;\n%.*s%s"
                      "u_viewProjectionMatrix * vec4(i_unwrapped, 0.0, 1.0)%s",
                      (int)(head - source), source, location, (int)(place - head), head, begin,
                      end);
}
