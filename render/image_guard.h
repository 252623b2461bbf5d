// SPDX-License-Identifier: Apache-2.0
/* How the files in C++ tell faults of OpenImageIO to their callers in C. */
#ifndef MXG_RENDER_IMAGE_GUARD_H
#define MXG_RENDER_IMAGE_GUARD_H

#include <cstdio>
#include <exception>
#include <new>
#include <string>

/* Some readers report several lines; this keeps the first. */
inline bool fail(char *reason, size_t capacity, const std::string &text)
{
    std::snprintf(reason, capacity, "%s",
                  text.empty() ? "unknown error" : text.substr(0, text.find('\n')).c_str());
    return false;
}

/*
 * Calls `work`. OpenImageIO and its format libraries throw for damaged files and for lack of
 * memory; no exception may reach the C code of the callers.
 */
template <typename Work> bool guard(char *reason, size_t capacity, Work work)
{
    try {
        return work();
    } catch (const std::bad_alloc &) {
        return fail(reason, capacity, "out of memory");
    } catch (const std::exception &fault) {
        return fail(reason, capacity, fault.what());
    } catch (...) {
        return fail(reason, capacity, "unknown error");
    }
}

#endif
