// SPDX-License-Identifier: Apache-2.0
#include "export/zip.h"

#include <stdlib.h>
#include <string.h>

enum {
    ALIGNMENT = 64,
    LOCAL = 30,       /* bytes of a header before the name */
    EXTRA = 4,        /* bytes of an extra field before its data */
    VERSION = 20,     /* of the format, times 10 */
    FIRST_DAY = 0x21, /* 1 January 1980: equal contents give equal archives */
    PADDING = 0x1986, /* the extra field that OpenUSD pads with */
    MAX_FILES = 65535
};

/* The CRC-32 of ISO 3309, which ZIP has. */
static uint32_t find_crc(const uint8_t *data, size_t size)
{
    uint32_t table[256], crc = 0xffffffff;
    for (uint32_t i = 0; i < 256; ++i) {
        table[i] = i;
        for (int bit = 0; bit < 8; ++bit)
            table[i] = table[i] >> 1 ^ (table[i] & 1 ? 0xedb88320 : 0);
    }
    for (size_t i = 0; i < size; ++i)
        crc = crc >> 8 ^ table[(crc ^ data[i]) & 255];
    return ~crc;
}

/* Writes the part that both headers have, from the version to the length of the name. */
static void put_common(struct memory_bytes *bytes, const char *name, uint32_t crc, size_t size)
{
    memory_append_number(bytes, VERSION, 2);
    memory_append_number(bytes, 0, 4); /* flags, method: stored */
    memory_append_number(bytes, (uint64_t)FIRST_DAY << 16, 4);
    memory_append_number(bytes, crc, 4);
    memory_append_number(bytes, size, 4);
    memory_append_number(bytes, size, 4);
    memory_append_number(bytes, strlen(name), 2);
}

bool zip_add(struct zip *zip, const char *name, const void *data, size_t size)
{
    const size_t at = zip->files.size, begin = at + LOCAL + strlen(name) + EXTRA;
    const size_t padding = (ALIGNMENT - begin % ALIGNMENT) % ALIGNMENT;
    if (begin + padding + size > UINT32_MAX || zip->num == MAX_FILES)
        return false;
    uint32_t crc = find_crc(data, size);
    memory_append(&zip->files, "PK\3\4", 4);
    put_common(&zip->files, name, crc, size);
    memory_append_number(&zip->files, EXTRA + padding, 2);
    memory_append(&zip->files, name, strlen(name));
    memory_append_number(&zip->files, PADDING, 2);
    memory_append_number(&zip->files, padding, 2);
    for (size_t i = 0; i < padding; ++i)
        memory_append_number(&zip->files, 0, 1);
    memory_append(&zip->files, data, size);

    memory_append(&zip->directory, "PK\1\2", 4);
    memory_append_number(&zip->directory, VERSION, 2);
    put_common(&zip->directory, name, crc, size);
    memory_append_number(&zip->directory, 0, 12); /* extra field, comment, disk, attributes */
    memory_append_number(&zip->directory, at, 4);
    memory_append(&zip->directory, name, strlen(name));
    ++zip->num;
    return true;
}

bool zip_end(struct zip *zip)
{
    const size_t at = zip->files.size, size = zip->directory.size;
    if (at + size > UINT32_MAX)
        return false;
    memory_append(&zip->files, zip->directory.data, size);
    memory_append(&zip->files, "PK\5\6", 4);
    memory_append_number(&zip->files, 0, 4); /* disks */
    memory_append_number(&zip->files, zip->num, 2);
    memory_append_number(&zip->files, zip->num, 2);
    memory_append_number(&zip->files, size, 4);
    memory_append_number(&zip->files, at, 4);
    memory_append_number(&zip->files, 0, 2); /* comment */
    return true;
}

void zip_finish(struct zip *zip)
{
    free(zip->files.data);
    free(zip->directory.data);
    *zip = (struct zip){0};
}
