//! Chromium behind its driver: a session a test, which ends with it.

use fantoccini::wd::{Capabilities, WebDriverCompatibleCommand};
use fantoccini::{Client, ClientBuilder};
use hyper_util::client::legacy::connect::HttpConnector;
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// Largest number of starts of a driver that finds no port.
const STARTS: u32 = 10;

/// Longest time that a driver may take to end.
const PATIENCE: Duration = Duration::from_secs(20);

/// A window of a browser without a screen. The driver ends when this is dropped, and the browser with it.
pub(crate) struct Browser {
    /// The session.
    pub(crate) client: Client,
    driver: Child,
    port: u16,
}

impl Drop for Browser {
    /// The driver ends its browsers when it is asked to end; one that is killed leaves them behind.
    fn drop(&mut self) {
        let asked = TcpStream::connect(("127.0.0.1", self.port)).and_then(|mut stream| {
            stream.set_read_timeout(Some(PATIENCE))?;
            write!(stream, "GET /shutdown HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n\r\n")?;
            stream.read_to_end(&mut Vec::new())
        });
        // best effort: a driver that has ended already is as good
        if asked.is_err() {
            let _ = self.driver.kill();
        }
        let _ = self.driver.wait();
    }
}

/// A command of Chromium's own, which the standard does not have.
#[derive(Debug)]
struct Own {
    path: &'static str,
    body: Value,
}

impl WebDriverCompatibleCommand for Own {
    fn endpoint(&self, base: &url::Url, session: Option<&str>) -> Result<url::Url, url::ParseError> {
        base.join(&format!("session/{}/{}", session.unwrap_or_default(), self.path))
    }

    fn method_and_body(&self, _: &url::Url) -> (http::Method, Option<String>) {
        (http::Method::POST, Some(self.body.to_string()))
    }
}

/// A driver and the port `[-]` that it listens on.
///
/// It lets the system choose a free port for IPv6 and ends if a connection of another test holds the same one of IPv4, so
/// that it is started anew then.
fn start() -> (Child, u16) {
    let mut said = String::new();
    for _ in 0..STARTS {
        let mut driver = Command::new("chromedriver")
            .arg("--port=0")
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("chromedriver starts: apt-get install chromium chromium-driver");
        said.clear();
        for line in BufReader::new(driver.stdout.take().expect("piped")).lines().map_while(Result::ok) {
            let port = line.split_once("successfully on port ").map(|(_, port)| port.trim_end_matches('.'));
            if let Some(port) = port.and_then(|port| port.parse().ok()) {
                return (driver, port);
            }
            said += &line;
            said.push('\n');
        }
        // best effort: it has closed its output, so that nothing more comes from it
        let _ = driver.kill();
        let _ = driver.wait();
    }
    panic!("chromedriver ended {STARTS} times before it listened; at last it said:\n{said}");
}

impl Browser {
    /// A window of this size `[px]`.
    pub(crate) async fn open(width: u32, height: u32) -> Self {
        let (driver, port) = start();
        let arguments =
            ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars"];
        let mut capabilities = Capabilities::new();
        capabilities.insert("goog:chromeOptions".to_owned(), json!({ "args": arguments }));
        capabilities.insert("goog:loggingPrefs".to_owned(), json!({ "browser": "ALL" }));
        let client = ClientBuilder::new(HttpConnector::new())
            .capabilities(capabilities)
            .connect(&format!("http://127.0.0.1:{port}"))
            .await
            .expect("a session");
        let browser = Self { client, driver, port };
        browser.of_size(width, height).await;
        browser
    }

    /// The page as on a screen of this size `[px]`; narrow ones are phones.
    pub(crate) async fn of_size(&self, width: u32, height: u32) {
        let size = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500 });
        self.tell("Emulation.setDeviceMetricsOverride", size).await;
    }

    /// The page as with a user's preference or on another medium.
    pub(crate) async fn with_media(&self, medium: &str, scheme: &str) {
        let features = json!([{ "name": "prefers-color-scheme", "value": scheme }]);
        self.tell("Emulation.setEmulatedMedia", json!({ "media": medium, "features": features })).await;
    }

    async fn tell(&self, command: &str, parameters: Value) -> Value {
        let body = json!({ "cmd": command, "params": parameters });
        self.client.issue_cmd(Own { path: "goog/cdp/execute", body }).await.expect(command)
    }

    /// Entries of the console since the last call.
    pub(crate) async fn console(&self) -> Vec<String> {
        let entries = self.client.issue_cmd(Own { path: "se/log", body: json!({ "type": "browser" }) }).await;
        let entries = entries.expect("the log of the browser");
        entries.as_array().into_iter().flatten().map(Value::to_string).collect()
    }

    /// Result of a script.
    pub(crate) async fn ask(&self, script: &str) -> Value {
        self.client.execute(script, Vec::new()).await.expect("a script without an error")
    }

    /// Result of a script that waits; its arguments end in the function that takes the answer.
    pub(crate) async fn wait_for(&self, script: &str, arguments: Vec<Value>) -> Value {
        self.client.execute_async(script, arguments).await.expect("a script without an error")
    }
}
