#pragma once
/// Orderly stop. SIGINT, SIGTERM and SIGHUP (its terminal is gone) only set a mark and wake who waits; a
/// second one does no more, so it cannot tear down a process that is bringing its drives to rest. Where
/// nobody has ever looked for the mark (a command that only computes) they end the process at once, as they
/// would any other.
namespace sprung {

void install_stop_signals();  ///< call before any thread is started; also ignores SIGPIPE
bool stop_requested() noexcept;
int stop_fd() noexcept;        ///< readable from the request on; -1 before install_stop_signals()
void request_stop() noexcept;  ///< what the signals do
/// As if nobody had asked or looked: what was asked for is under way, and the next signal ends the process.
void clear_stop_request() noexcept;

/// SIGTERM to this process when the thread that started it ends; at once when it has ended already.
/// @param parent_pid getpid() of the parent as known before; 0 = whoever it is now.
void stop_with_parent(int parent_pid = 0);

}  // namespace sprung
