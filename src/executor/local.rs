//! Child processes on this machine.

use std::fs::File;
use std::io::{BufRead, BufReader, Write};
use std::os::unix::process::CommandExt;
use std::process::{Child, ChildStdin, Command, ExitStatus, Stdio};
use std::sync::mpsc::Sender;
use std::thread::{self, JoinHandle};

use super::{ExecutorError, Launch, Progress};

/// What a child tells.
#[derive(Debug)]
pub enum Event {
    /// The number of its job, and how far it is.
    Progress(usize, Progress),
    /// It has closed its output: it has ended, or is about to.
    Closed,
}

/// A solver at work. It is asked to stop when dropped, and waited for.
#[derive(Debug)]
pub struct Running {
    child: Child,
    /// Open as long as the child shall go on. It closes by itself if this process dies, so that no orphan computes on.
    leash: Option<ChildStdin>,
    /// Hears what it says.
    listener: Option<JoinHandle<()>>,
}

/// Starts a solver, away from the terminal's Ctrl-C; its standard error goes to the log.
pub fn start(job: usize, launch: &Launch, log: File, events: Sender<Event>) -> Result<Running, ExecutorError> {
    let failed = |source| ExecutorError::Start {
        program: launch.program.clone(),
        source,
    };
    let errors = log.try_clone().map_err(failed)?;
    let mut child = Command::new(&launch.program)
        .args(&launch.arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(errors)
        .process_group(0)
        .spawn()
        .map_err(failed)?;
    let leash = child.stdin.take();
    let output = child.stdout.take().expect("its output was asked for above");
    let listener = thread::spawn(move || listen(job, BufReader::new(output), log, &events));
    Ok(Running {
        child,
        leash,
        listener: Some(listener),
    })
}

/// Progress becomes events; everything else that a child says belongs in its log.
fn listen(job: usize, output: impl BufRead, mut log: File, events: &Sender<Event>) {
    for line in output.split(b'\n').map_while(Result::ok) {
        let line = String::from_utf8_lossy(&line);
        // The receiver is gone only when nobody wants to know any more, and a log that cannot be written loses only words.
        let _ = match Progress::parse(&line) {
            Some(progress) => events.send(Event::Progress(job, progress)).map_err(drop),
            None => writeln!(log, "{line}").map_err(drop),
        };
    }
    let _ = events.send(Event::Closed);
}

impl Running {
    /// Asks it to write a checkpoint and stop.
    pub fn interrupt(&mut self) {
        self.leash = None;
    }

    /// Ends it at once; it goes on from its last checkpoint next time.
    pub fn kill(&mut self) {
        // That it has ended by itself meanwhile is the only way in which this fails.
        let _ = self.child.kill();
    }

    /// How it ended, once all that it said is in its log; `None` while it goes on.
    pub fn ended(&mut self) -> Option<ExitStatus> {
        let status = self.child.try_wait().ok().flatten()?;
        // A published log must not grow any more. A listener that has panicked has nothing more to write.
        let _ = self.listener.take().map(JoinHandle::join);
        Some(status)
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.interrupt();
        let _ = self.child.wait();
    }
}
