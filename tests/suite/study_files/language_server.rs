//! The YAML language server, which editors use, opens and checks what is shipped. `make test-setup` installs it where there
//! is npm.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde_json::{Value, json};

/// Seconds after which the server is taken to hang, on a machine with other work.
const HANGS: &str = "120";

#[allow(clippy::print_stderr, reason = "who runs the tests learns that one was left out")]
fn program() -> Option<PathBuf> {
    let top = Path::new(env!("CARGO_MANIFEST_DIR"));
    let program = top.join("target/node/node_modules/yaml-language-server/bin/yaml-language-server");
    if !program.exists() {
        eprintln!(
            "skipped: {} is not there; `make test-setup` installs it where there is npm",
            program.display()
        );
    }
    program.exists().then_some(program)
}

/// A server that speaks on its standard input and output.
struct Server {
    child: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
    asked: u64,
}

impl Server {
    fn start(program: &Path) -> Server {
        let mut child = Command::new("timeout")
            .args([HANGS, "node"])
            .arg(program)
            .arg("--stdio")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let (input, output) = (child.stdin.take().unwrap(), child.stdout.take().unwrap());
        let output = BufReader::new(output);
        let mut server = Server {
            child,
            input,
            output,
            asked: 0,
        };
        let capabilities = json!({"workspace": {"configuration": true}});
        server.ask(
            "initialize",
            json!({"processId": null, "rootUri": null, "capabilities": capabilities}),
        );
        server.send(json!({"method": "initialized", "params": {}}));
        server
    }

    fn send(&mut self, mut message: Value) {
        message["jsonrpc"] = json!("2.0");
        let text = message.to_string();
        write!(self.input, "Content-Length: {}\r\n\r\n{text}", text.len()).unwrap();
        self.input.flush().unwrap();
    }

    fn receive(&mut self) -> Value {
        let mut length = 0;
        loop {
            let mut line = String::new();
            assert!(self.output.read_line(&mut line).unwrap() > 0, "the server has ended");
            match line.trim().split_once(": ") {
                Some(("Content-Length", number)) => length = number.parse().unwrap(),
                Some(_) => {}
                None => break,
            }
        }
        let mut text = vec![0; length];
        self.output.read_exact(&mut text).unwrap();
        serde_json::from_slice(&text).unwrap()
    }

    /// Answers what the server asks until it says what is wanted.
    fn wait_for(&mut self, is_it: impl Fn(&Value) -> bool) -> Value {
        loop {
            let message = self.receive();
            if is_it(&message) {
                return message;
            }
            if message["id"].is_null() || message["method"].is_null() {
                continue;
            }
            let settings = |item: &Value| match item["section"] == "yaml" {
                true => json!({"validate": true, "completion": true, "hover": true, "schemaStore": {"enable": false}}),
                false => json!({}),
            };
            let result = match message["method"] == "workspace/configuration" {
                true => message["params"]["items"]
                    .as_array()
                    .unwrap()
                    .iter()
                    .map(settings)
                    .collect(),
                false => Value::Null,
            };
            self.send(json!({"id": message["id"], "result": result}));
        }
    }

    fn ask(&mut self, method: &str, params: Value) -> Value {
        self.asked += 1;
        let id = self.asked;
        self.send(json!({"id": id, "method": method, "params": params}));
        self.wait_for(|message| message["id"] == id && message["method"].is_null())["result"].clone()
    }

    /// What it says of a text that is opened under this path: line, counted from 1, and message.
    fn complaints(&mut self, path: &Path, text: &str) -> Vec<(u64, String)> {
        let uri = uri(path);
        let document = json!({"uri": uri, "languageId": "yaml", "version": 1, "text": text});
        self.send(json!({"method": "textDocument/didOpen", "params": {"textDocument": document}}));
        let told = self.wait_for(|message| {
            message["method"] == "textDocument/publishDiagnostics" && message["params"]["uri"] == uri.as_str()
        });
        let complaints = told["params"]["diagnostics"].as_array().unwrap().iter();
        let line = |complaint: &Value| complaint["range"]["start"]["line"].as_u64().unwrap() + 1;
        complaints
            .map(|complaint| (line(complaint), complaint["message"].to_string()))
            .collect()
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // It may have ended.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn uri(path: &Path) -> String {
    format!("file://{}", path.display())
}

fn studies() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("studies")
}

#[test]
fn every_shipped_study_opens_without_a_complaint() {
    let Some(program) = program() else { return };
    let mut server = Server::start(&program);
    let mut opened = 0;
    for entry in fs::read_dir(studies()).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "yaml") {
            let text = fs::read_to_string(&path).unwrap();
            let complaints = server.complaints(&path, &text);
            assert!(complaints.is_empty(), "{}: {complaints:?}", path.display());
            opened += 1;
        }
    }
    assert!(opened > 10, "{opened}");
}

#[test]
fn a_wrong_unit_an_unknown_key_and_a_wrong_sweep_path_are_found_where_they_stand() {
    let Some(program) = program() else { return };
    let mut server = Server::start(&program);
    let text = fs::read_to_string(studies().join("quickstart.yaml")).unwrap();
    let wrong = [
        ("length: 115 nm", "length: 115 ps"),
        ("epsilon: 0.415 eV", "epsilon: 0.415 ev"),
        ("grips: clamped", "grip: clamped"),
        ("\ncases:", "\nsweep: {specimen.lenght: [10 nm, 20 nm]}\ncases:"),
    ];
    for (number, (right, wrong)) in wrong.into_iter().enumerate() {
        let before = text.find(right).unwrap();
        let line = text[..before].matches('\n').count() + 1 + usize::from(right.starts_with('\n'));
        let path = studies().join(format!("wrong-{number}.yaml"));
        let complaints = server.complaints(&path, &text.replacen(right, wrong, 1));
        assert!(
            complaints.iter().any(|(at, _)| *at == line as u64),
            "{wrong} in line {line}: {complaints:?}"
        );
    }
}

#[test]
fn keys_are_completed_and_explained() {
    let Some(program) = program() else { return };
    let mut server = Server::start(&program);
    let text = fs::read_to_string(studies().join("quickstart.yaml")).unwrap();
    let text = text.replacen("\n  run:\n", "\n  run:\n    \n", 1);
    let path = studies().join("typing.yaml");
    server.complaints(&path, &text);
    let before = text.find("\n  run:\n").unwrap();
    let line = text[..before].matches('\n').count() + 2;
    let place = json!({"textDocument": {"uri": uri(&path)}, "position": {"line": line, "character": 4}});
    let offered = server.ask("textDocument/completion", place);
    let items = offered["items"].as_array().unwrap();
    let summation = items.iter().find(|item| item["label"] == "summation");
    let summation = summation.unwrap_or_else(|| panic!("{offered}"));
    assert!(
        summation["documentation"].to_string().len() > 20,
        "it says what the key means: {summation}"
    );
}
