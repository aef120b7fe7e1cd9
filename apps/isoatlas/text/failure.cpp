#include "text/failure.h"

#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <system_error>

#include <unistd.h>

#include "text/advice.h"

namespace isoatlas::cli {
namespace {

Error bug(const std::string& what) {
    return {ErrorKind::internal,
            {.what = "a bug of isoatlas: " + what,
             .next = "please report it with the command line and, if you may share it, the file",
             .reason = Reason::bug}};
}

/// Has the system run out of a resource?
bool is_refusal(const std::error_code& code) {
    for (const std::errc lack : {std::errc::resource_unavailable_try_again, std::errc::not_enough_memory, std::errc::too_many_files_open,
                                 std::errc::too_many_files_open_in_system, std::errc::no_space_on_device})
        if (code == lack) return true;
    return false;
}

void say(const char* text) { [[maybe_unused]] const ssize_t said = ::write(STDERR_FILENO, text, std::strlen(text)); }

[[noreturn]] void end() noexcept {
    if (std::current_exception() == nullptr) {
        say("isoatlas: a bug of isoatlas: it terminated without an exception. Next: please report it with the command line\n");
        ::_exit(static_cast<int>(ErrorKind::internal));
    }
    try {
        throw;
    } catch (const std::bad_alloc&) {  // nothing more can be allocated
        say("isoatlas: not enough memory. Next: use a machine with more memory, or allow this process more (ulimit -v)\n");
        ::_exit(static_cast<int>(ErrorKind::resource));
    } catch (...) {
        const Error error = with_options(failure());
        say("isoatlas: ");
        say(error.what());
        say("\n");
        ::_exit(static_cast<int>(error.kind()));
    }
}

}  // namespace

Error failure() noexcept {
    try {
        throw;
    } catch (const Error& error) {
        return error;
    } catch (const std::bad_alloc&) {
        return {ErrorKind::resource,
                {.what = "not enough memory",
                 .next = "isoatlas info FILE prints the memory of an analysis; use a machine with more memory",
                 .reason = Reason::not_enough_memory}};
    } catch (const std::system_error& error) {
        if (!is_refusal(error.code())) return bug(error.what());
        return {ErrorKind::resource,
                {.what = std::string("the system denied a resource: ") + error.what(),
                 .next = "allow this process more memory, threads and open files (ulimit -v, -u, -n)"}};
    } catch (const std::exception& error) {
        return bug(error.what());
    } catch (...) {
        return bug("an unknown exception");
    }
}

void end_with_exit_codes() { std::set_terminate(end); }

}  // namespace isoatlas::cli
