//! Progress of long work, on a terminal only.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A bar of a thousandth's steps that appears when the work takes longer than a blink.
pub fn bar(what: &str) -> ProgressBar {
    // Nothing is drawn where standard error is no terminal.
    let bar = ProgressBar::with_draw_target(Some(1000), ProgressDrawTarget::stderr());
    if let Ok(style) = ProgressStyle::with_template("{msg:24} {bar:40} {percent:>3} %  {elapsed}") {
        bar.set_style(style);
    }
    bar.set_message(what.to_owned());
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

/// Moves a bar to a share of the work, 0…1, never back.
pub fn advance(bar: &ProgressBar, share: f64) {
    let position = (1000.0 * share.clamp(0.0, 1.0)) as u64;
    if position > bar.position() {
        bar.set_position(position);
    }
}
