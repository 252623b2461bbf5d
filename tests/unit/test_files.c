// SPDX-License-Identifier: Apache-2.0
/* Questions of the library to the file system: the files of a folder, and those that a sandbox lets
 * documents read. */
#define _XOPEN_SOURCE 700
#include "api/file_system.h"
#include "api/generation.h"

#include "unit/test.h"

#ifdef _WIN32
#include <direct.h>
#include <io.h>
#else
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

/* The name ends with "XXXXXX", which becomes something that no folder has. */
static bool make_unique_folder(char *name)
{
#ifdef _WIN32
    return _mktemp(name) && _mkdir(name) == 0;
#else
    return mkdtemp(name) != NULL;
#endif
}

static bool make_plain_folder(const char *name)
{
#ifdef _WIN32
    return _mkdir(name) == 0;
#else
    return mkdir(name, 0777) == 0;
#endif
}

static void write_file(const char *path)
{
    FILE *file = fopen(path, "w");
    if (REQUIRE(file != NULL))
        fclose(file);
}

static const char *const made_files[] = {"b.mtlx", "a.mtlx", "deep/c.mtlx", "deep/d.png",
                                         ".hidden.mtlx"};

/* In a folder of its own, which it then stands in. */
static void make_folder(char *folder)
{
    REQUIRE(make_unique_folder(folder) && chdir(folder) == 0 && make_plain_folder("deep"));
    for (size_t i = 0; i < sizeof made_files / sizeof *made_files; i++)
        write_file(made_files[i]);
}

static void remove_folder(const char *folder)
{
    for (size_t i = 0; i < sizeof made_files / sizeof *made_files; i++)
        REQUIRE(unlink(made_files[i]) == 0);
    REQUIRE(rmdir("deep") == 0 && chdir("..") == 0 && rmdir(folder) == 0);
}

static void test_folders(void)
{
    struct mem mem;
    struct arena arena;
    struct path_list found = {0};
    size_t size = 0, needed = 0;
    char names[256], folder[] = "unit_files_XXXXXX";
    mem_init(&mem, NULL, NULL);
    arena_init(&arena, &mem);
    make_folder(folder);
    REQUIRE(folder_exists("deep") && !folder_exists("a.mtlx") && !folder_exists("none"));
    REQUIRE(!folder_list(&arena, ".", ".mtlx", &found));
    REQUIRE_EQ(found.len, 3); /* sorted, without what is hidden */
    REQUIRE_STR(found.items[0], "./a.mtlx");
    REQUIRE_STR(found.items[1], "./b.mtlx");
    REQUIRE_STR(found.items[2], "./deep/c.mtlx");
    REQUIRE(folder_list(&arena, "none", ".mtlx", &found) != NULL);
    REQUIRE(!folder_names("deep", names, sizeof names, &size));
    REQUIRE_EQ(size, strlen(".") + strlen("..") + strlen("c.mtlx") + strlen("d.png") + 4);
    REQUIRE(!folder_names("deep", names, 0, &needed));
    REQUIRE_EQ(needed, size);
    remove_folder(folder);
    arena_finish(&arena);
}

/* In a sandbox a document may refer to files beside what the caller named, and below. */
static void test_sandbox(void)
{
    char folder[] = "unit_files_XXXXXX";
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    mxg_context *context = NULL;
    make_folder(folder);
    desc.sandbox = true;
    REQUIRE_EQ(mxg_context_create(&desc, &context), MXG_OK);
    REQUIRE(sandbox_fault(context, "deep/c.mtlx") != NULL);
    REQUIRE(sandbox_admit_file(context, "deep/d.png"));
    REQUIRE(!sandbox_fault(context, "deep/c.mtlx"));
    REQUIRE(sandbox_fault(context, "a.mtlx") != NULL);
    REQUIRE(sandbox_fault(context, "deep/../a.mtlx") != NULL);
    REQUIRE(sandbox_fault(context, "none.mtlx") != NULL); /* whether it exists or not */
    REQUIRE(sandbox_fault(context, "deep/../none.mtlx") != NULL);
    REQUIRE(sandbox_fault(context, "/no/such/folder/none.mtlx") != NULL);
#ifdef _WIN32
    REQUIRE(sandbox_fault(context, "deep\\..\\a.mtlx") != NULL);
    REQUIRE(sandbox_fault(context, "deep\\..\\none.mtlx") != NULL);
    REQUIRE(sandbox_fault(context, "C:\\none.mtlx") != NULL);
    REQUIRE(!sandbox_fault(context, "deep\\c.mtlx"));
#else
    /* Links are followed. On Windows they need rights. */
    static const char *const links[] = {"../a.mtlx", "../none.mtlx"};
    for (size_t i = 0; i < sizeof links / sizeof *links; i++) {
        REQUIRE(symlink(links[i], "deep/link.mtlx") == 0);
        REQUIRE(sandbox_fault(context, "deep/link.mtlx") != NULL);
        REQUIRE(unlink("deep/link.mtlx") == 0);
    }
#endif
    REQUIRE(!sandbox_fault(context, "deep/none.mtlx")); /* opening it tells why */
    REQUIRE(!sandbox_fault(context, "deep/no/folder/none.mtlx"));
    REQUIRE(sandbox_admit_folder(context, "."));
    REQUIRE(!sandbox_fault(context, "a.mtlx"));
    mxg_context_destroy(context);
    desc.sandbox = false;
    REQUIRE_EQ(mxg_context_create(&desc, &context), MXG_OK);
    REQUIRE(!sandbox_fault(context, "a.mtlx"));
    mxg_context_destroy(context);
    remove_folder(folder);
}

/* Names from a folder with "in", "lib" and "secret"; the first two are allowed. */
static const struct {
    const char *path;
    bool is_allowed;
} ways_up[] = {
    {"in/a.mtlx", true},
    {"in/deep/../a.mtlx", true},
    {"in/none/../a.mtlx", true}, /* opening it tells that there is no such folder */
    {"in/deep/../../in/a.mtlx", true},
    {"in/deep/../../lib/b.mtlx", true},
    {"lib/../in/a.mtlx", true},
    {"./lib/.././in//deep/../a.mtlx", true},
    {"in/../secret/../in/a.mtlx", false},
    {"in/../none/../in/a.mtlx", false},
    {"in/../secret/deep/../../in/a.mtlx", false},
    {"in/../secret/none/../../in/a.mtlx", false},
    {"in/../none/none/../../in/a.mtlx", false},
    {"in/none/../../secret/../in/a.mtlx", false},
    {"in/none/../../none/../in/a.mtlx", false},
    {"lib/../secret/../in/a.mtlx", false},
    {"lib/../secretary/../in/a.mtlx", false},
    {"none/../in/a.mtlx", false},
    {"in/deep/../../lib/../secret/../in/a.mtlx", false},
    {"in/a.mtlx/../../secret/../in/a.mtlx", false},
};
enum { NUM_WAYS_UP = sizeof ways_up / sizeof *ways_up };

/* A way up out of a folder that is none of the allowed ones, and around none, tells nothing. */
static void test_ways_up(void)
{
    static const char given[] = "secret/../in/a.mtlx";
    static const char *const folders[] = {"in", "in/deep", "lib", "secret", "secret/deep"};
    enum { NUM_FOLDERS = sizeof folders / sizeof *folders };
    char folder[] = "unit_files_XXXXXX", path[PATH_MAX + 64], whole[PATH_MAX];
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    mxg_context *context = NULL;
    make_folder(folder);
    for (size_t i = 0; i < NUM_FOLDERS; i++)
        REQUIRE(make_plain_folder(folders[i]));
    desc.sandbox = true;
    REQUIRE(file_real_path(".", whole));
    for (int is_given = 0; is_given < 2; is_given++) {
        REQUIRE_EQ(mxg_context_create(&desc, &context), MXG_OK);
        REQUIRE(sandbox_admit_file(context, is_given ? given : "in/a.mtlx"));
        REQUIRE(sandbox_admit_folder(context, "lib/"));
        for (size_t i = 0; i < NUM_WAYS_UP; i++) {
            REQUIRE_EQ(!sandbox_fault(context, ways_up[i].path), ways_up[i].is_allowed);
            snprintf(path, sizeof path, "%s/%s", whole, ways_up[i].path);
            REQUIRE_EQ(!sandbox_fault(context, path), ways_up[i].is_allowed);
        }
        const char *same_way = "secret/../in/deep/../a.mtlx"; /* as the caller went, and further */
        REQUIRE_EQ(!sandbox_fault(context, same_way), is_given);
        REQUIRE(!mxg_context_file_fault(context, given, same_way));
        snprintf(path, sizeof path, "%s/%s", given, "../../none/../in/a.mtlx");
        REQUIRE(mxg_context_file_fault(context, given, path) != NULL);
        mxg_context_destroy(context);
    }
    for (size_t i = NUM_FOLDERS; i-- > 0;)
        REQUIRE(rmdir(folders[i]) == 0);
    remove_folder(folder);
}

int main(void)
{
    test_folders();
    test_sandbox();
    test_ways_up();
    return test_report("files");
}
