// How many pixels a picture may have. What a picture costs tells it, not the name of whatever draws: where it is
// slow there are fewer pixels, where it is quick there are more, which are averaged and smooth the edges.

export const kRatios = [0.5, 0.75, 1, 2];  // pixels for each of the page's, along each axis
const kBegin = 2;
const kSlow_ms = 40;
const kQuick_ms = 25;  // one picture of a screen of 60 Hz, and some
const kSlowPictures = 3;
const kQuickPictures = 30;
const kStill_ms = 400;

/** A core: takes times, keeps a ratio. */
export class Sharpness {
  constructor() {
    this.at = kBegin;
    this.most = kRatios.length - 1;  // a ratio that was too slow once is not tried again
    this.slow = this.quick = 0;
  }

  get ratio() {
    return kRatios[this.at];
  }

  /** What the newest picture took. @return whether the ratio is another one now */
  took(picture_ms) {
    this.slow = picture_ms > kSlow_ms ? this.slow + 1 : 0;
    this.quick = picture_ms < kQuick_ms ? this.quick + 1 : 0;
    if (this.slow >= kSlowPictures && this.at > 0) {
      this.most = --this.at;
      this.slow = 0;
      return true;
    }
    if (this.quick < kQuickPictures || this.at >= this.most) return false;
    this.at += 1;
    this.quick = 0;
    return true;
  }

  /** For a picture that has stood still for so long: it may take its time. */
  still_ratio(still_ms) {
    return still_ms > kStill_ms ? Math.max(1, this.ratio) : this.ratio;
  }
}

/** When the drawing is done, which is later than the page's script has asked for it. */
export class PictureClock {
  constructor(gl) {
    this.gl = gl;
    this.fence = null;
  }

  begin(now_ms) {
    this.begin_ms = now_ms;
  }

  /** All of the picture has been asked for. */
  asked() {
    this.fence = this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.gl.flush();
  }

  get busy() {
    return this.fence !== null;
  }

  /** @return ms from begin() on where the picture has been done since the last call, else null */
  done(now_ms) {
    if (this.fence === null) return null;
    const state = this.gl.getSyncParameter(this.fence, this.gl.SYNC_STATUS);
    if (state !== this.gl.SIGNALED && !this.gl.isContextLost()) return null;
    this.gl.deleteSync(this.fence);
    this.fence = null;
    return now_ms - this.begin_ms;
  }
}
