// SPDX-License-Identifier: Apache-2.0
/* The file system of Windows. Names have the bytes of the code page of the process. */
#include "api/file_system.h"

#include <string.h>
#include <windows.h>

/* A handle that reads no contents, of a file or a folder. */
static HANDLE open_file(const char *path)
{
    return CreateFileA(path, 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, NULL,
                       OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, NULL);
}

static uint64_t pair(DWORD high, DWORD low)
{
    return (uint64_t)high << 32 | low;
}

struct file_facts file_facts(const char *path)
{
    struct file_facts facts = {.kind = FILE_MISSING};
    BY_HANDLE_FILE_INFORMATION info;
    HANDLE file = open_file(path);
    if (file == INVALID_HANDLE_VALUE)
        return facts;
    facts.kind = FILE_OTHER;
    if (GetFileType(file) == FILE_TYPE_DISK && GetFileInformationByHandle(file, &info))
        facts = (struct file_facts){
            .kind = info.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY ? FILE_FOLDER : FILE_REGULAR,
            .device = info.dwVolumeSerialNumber,
            .number = pair(info.nFileIndexHigh, info.nFileIndexLow),
            .size = pair(info.nFileSizeHigh, info.nFileSizeLow),
        };
    CloseHandle(file);
    return facts;
}

bool file_has_entry(const char *path)
{
    return GetFileAttributesA(path) != INVALID_FILE_ATTRIBUTES;
}

/* Final paths begin with "\\?\", which stays: all of them have it. */
bool file_real_path(const char *path, char out[PATH_MAX])
{
    HANDLE file = open_file(path);
    if (file == INVALID_HANDLE_VALUE)
        return false;
    DWORD len = GetFinalPathNameByHandleA(file, out, PATH_MAX, FILE_NAME_NORMALIZED);
    CloseHandle(file);
    if (!len || len >= PATH_MAX)
        return false;
    for (char *c = out; *c; c++)
        if (*c == '\\')
            *c = '/';
    return true;
}

bool file_is_separator(char c)
{
    return c == '/' || c == '\\';
}

const char *folder_names(const char *folder, char *names, size_t capacity, size_t *out_size)
{
    char pattern[PATH_MAX];
    WIN32_FIND_DATAA entry;
    size_t folder_len = strlen(folder);
    *out_size = 0;
    if (folder_len + sizeof "/*" > sizeof pattern)
        return "its name is too long";
    memcpy(pattern, folder, folder_len);
    memcpy(pattern + folder_len, "/*", sizeof "/*");
    HANDLE search = FindFirstFileA(pattern, &entry);
    if (search == INVALID_HANDLE_VALUE)
        return "it is no folder, or closed";
    do {
        size_t len = strlen(entry.cFileName) + 1;
        if (*out_size + len <= capacity)
            memcpy(names + *out_size, entry.cFileName, len);
        *out_size += len;
    } while (FindNextFileA(search, &entry));
    FindClose(search);
    return NULL;
}
