//! `laneweave view`.

use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;

use clap::{Args, ValueHint};
use laneweave::Fault;
use laneweave::output::write_whole;
use laneweave_studies::branch::Setting;
use laneweave_viewer::{Doorway, Server, Source, Token, export};

use super::complain;
use super::numbers::{number, within};
use super::say;
use super::shown::ShownArguments;
use super::stop::Stop;

#[derive(Debug, Args)]
pub(crate) struct ViewArguments {
    #[command(flatten)]
    shown: ShownArguments,
    /// Show beside a run that has ended its twin: the time from which on the twin has other settings, in seconds as in
    /// the tables.
    #[arg(long, value_name = "S", conflicts_with = "export")]
    at: Option<f64>,
    /// What is different in the twin: a key of all styles (style.speed.weight=2), or of one style
    /// (aggressive.follow.jam_gap=3); or other commands of users (commands=FILE, or commands=none); may be repeated.
    #[arg(long = "set", value_name = "STYLE.KEY=VALUE|commands=FILE", requires = "at")]
    settings: Vec<Setting>,
    /// The port of the page [default: any free one].
    #[arg(long, value_name = "PORT", value_parser = within::<u16>(0..=u16::MAX), default_value_t = 0, hide_default_value = true)]
    port: u16,
    /// The address of this machine under which other machines see the page; whoever knows the address of the page can
    /// do what you can do there.
    #[arg(long, value_name = "IP", default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST))]
    address: IpAddr,
    /// Folder in which scenarios are saved with what was done by hand.
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath, default_value = "saved")]
    save: PathBuf,
    /// Print the address of the page, and open no browser.
    #[arg(long)]
    no_browser: bool,
    /// Write a run that has ended, or a recording, into this file instead: the page with all of it, which plays without
    /// a server and without a network.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    export: Option<PathBuf>,
    /// Seconds between two frames of the file.
    #[arg(long, value_name = "S", value_parser = number, default_value = "0.5", requires = "export")]
    every: f64,
}

impl ViewArguments {
    /// Serves the page until the user stops it.
    pub(crate) fn execute(self) -> Result<(), Fault> {
        let mut source = match self.at {
            Some(at) => self.shown.shown().twins(at, &self.settings)?,
            None => self.shown.shown().source(&self.save)?,
        };
        if let Some(path) = &self.export {
            return self.write(path, &mut *source);
        }
        let stop = Stop::listen()?;
        let address = SocketAddr::new(self.address, self.port);
        let server = Server::start(source, address, Token::new()).map_err(|error| {
            Fault::new(format!("view: {address}"), error, "choose another --port or --address")
        })?;
        say(&format!("{}\nCtrl-C ends it.\n", server.url()))?;
        let _doorway = if self.no_browser { None } else { open_browser(&server.url()) };
        while !stop.is_raised() {
            thread::sleep(Duration::from_millis(50));
        }
        Ok(())
    }

    /// Writes the page with all of the traffic.
    fn write(&self, path: &Path, source: &mut dyn Source) -> Result<(), Fault> {
        /// Frames of a longer time than this would show vehicles beside the road [s].
        const RANGE: [f64; 2] = [0.01, 10.0];
        let [least, most] = RANGE;
        if !(least..=most).contains(&self.every) {
            let what = format!("{} s between two frames", self.every);
            return Err(Fault::new("--every", what, format!("choose {least} to {most} s")));
        }
        let text = export(source, self.every, |_| {})?;
        write_whole(path, &text)?;
        let size = text.len() as f64 / 1e6;
        say(&format!("{}: {size:.1} MB, plays in any browser\n", path.display()))
    }
}

/// Opens a browser, which is led to `address` for as long as the file that is returned is there.
fn open_browser(address: &str) -> Option<Doorway> {
    let opened = Doorway::to(address).and_then(|it| open::that_detached(it.path()).map(|()| it));
    if opened.is_err() {
        complain(format_args!("no browser could be opened: open this address yourself"));
    }
    opened.ok()
}
