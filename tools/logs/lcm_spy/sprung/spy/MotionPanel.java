package sprung.spy;

import java.awt.BasicStroke;
import java.awt.Color;
import java.awt.Graphics;
import java.awt.Graphics2D;
import java.awt.RenderingHints;
import java.awt.geom.Path2D;
import java.util.List;
import java.util.ResourceBundle;
import javax.swing.JPanel;

/** Torques of all joints as lines, above them a strip for each leg whose colour is the phase. */
final class MotionPanel extends JPanel {
    /** By leg phase (sprung::LegPhase). */
    static final Color[] PHASES = {
        new Color(0xD9D9D9), new Color(0xA6CEE3), new Color(0xFDBF6F), new Color(0xE31A1C), new Color(0xFFFF99),
        new Color(0xFB9A99), new Color(0xCAB2D6), new Color(0xFFED6F), new Color(0xB2DF8A), new Color(0x80B1D3),
    };
    /** Joints in turn. */
    static final Color[] JOINTS = {
        new Color(0x1B6CA8), new Color(0xD1495B), new Color(0x2E8B57), new Color(0x8E44AD), new Color(0xE67E22),
        new Color(0x16A085), new Color(0x7F5539), new Color(0xC71585), new Color(0x556B2F), new Color(0x4B5D67),
        new Color(0xB8860B), new Color(0x3A3A98),
    };
    private static final int LEFT = 62;
    private static final int RIGHT = 12;
    private static final int TOP = 28;
    private static final int STRIP = 18;
    private static final int LEGEND = 44;
    private static final ResourceBundle NAMES = ResourceBundle.getBundle("sprung.spy.phases");

    private final transient MotionHistory history;
    private final String[] joints = System.getProperty("sprung.joints", "").split(",");
    private final String[] legs = System.getProperty("sprung.legs", "").split(",");

    MotionPanel(MotionHistory history) {
        this.history = history;
    }

    @Override
    protected void paintComponent(Graphics graphics) {
        paint((Graphics2D) graphics, getWidth(), getHeight());
    }

    void paint(Graphics2D g, int width, int height) {
        g.setRenderingHint(RenderingHints.KEY_ANTIALIASING, RenderingHints.VALUE_ANTIALIAS_ON);
        g.setRenderingHint(RenderingHints.KEY_TEXT_ANTIALIASING, RenderingHints.VALUE_TEXT_ANTIALIAS_ON);
        g.setColor(Color.WHITE);
        g.fillRect(0, 0, width, height);
        final List<MotionHistory.Torques> torques = history.torques();
        final List<MotionHistory.Phases> phases = history.phases();
        final double end_s = Math.max(torques.isEmpty() ? 0 : torques.get(torques.size() - 1).time_s,
            phases.isEmpty() ? 0 : phases.get(phases.size() - 1).time_s);
        final int plotWidth = width - LEFT - RIGHT;
        final int strips = phases.isEmpty() ? 0 : phases.get(phases.size() - 1).phases.length;
        final int top = TOP + strips * STRIP + 8;
        title(g, torques, phases);
        strips(g, phases, end_s, plotWidth);
        lines(g, torques, end_s, plotWidth, top, height - LEGEND - 20);
        legend(g, torques, height - LEGEND + 16, width);
    }

    private static double x(double time_s, double end_s, int plotWidth) {
        return LEFT + plotWidth * (1.0 - (end_s - time_s) / MotionHistory.SECONDS);
    }

    private void title(Graphics2D g, List<MotionHistory.Torques> torques, List<MotionHistory.Phases> phases) {
        g.setColor(Color.BLACK);
        String text = "Gear output torque, Nm, and phases of the legs: last 10 s";
        if (!phases.isEmpty()) {
            text += "   state: " + phases.get(phases.size() - 1).state;
        }
        if (torques.isEmpty()) {
            text = "waiting for JOINT_STATE and MOTION_STATE";
        }
        g.drawString(history.complaint().isEmpty() ? text : history.complaint(), LEFT, 18);
    }

    private void strips(Graphics2D g, List<MotionHistory.Phases> phases, double end_s, int plotWidth) {
        for (int i = 0; i < phases.size(); ++i) {
            final MotionHistory.Phases here = phases.get(i);
            final double until_s = i + 1 < phases.size() ? phases.get(i + 1).time_s : end_s;
            final int left = (int) x(here.time_s, end_s, plotWidth);
            final int right = (int) Math.ceil(x(until_s, end_s, plotWidth));
            for (int leg = 0; leg < here.phases.length; ++leg) {
                g.setColor(PHASES[Math.floorMod(here.phases[leg], PHASES.length)]);
                g.fillRect(left, TOP + leg * STRIP, right - left, STRIP - 2);
            }
        }
        if (phases.isEmpty()) {
            return;
        }
        g.setColor(Color.BLACK);
        final int[] last = phases.get(phases.size() - 1).phases;
        for (int leg = 0; leg < last.length; ++leg) {
            final int baseline = TOP + leg * STRIP + STRIP - 6;
            g.drawString(name(legs, leg, "leg"), 6, baseline);
            final String phase = phaseName(last[leg]);
            g.drawString(phase, LEFT + plotWidth - g.getFontMetrics().stringWidth(phase) - 4, baseline);
        }
    }

    private static void lines(Graphics2D g, List<MotionHistory.Torques> torques, double end_s, int plotWidth, int top, int bottom) {
        double low = -1.0;
        double high = 1.0;
        for (MotionHistory.Torques here : torques) {
            for (double torque_Nm : here.torque_Nm) {
                low = Double.isFinite(torque_Nm) ? Math.min(low, torque_Nm) : low;
                high = Double.isFinite(torque_Nm) ? Math.max(high, torque_Nm) : high;
            }
        }
        final double scale = (bottom - top) / (high - low);
        axes(g, low, high, plotWidth, top, bottom);
        final int count = torques.isEmpty() ? 0 : torques.get(torques.size() - 1).torque_Nm.length;
        g.setStroke(new BasicStroke(1.2f));
        for (int joint = 0; joint < count; ++joint) {
            final Path2D path = new Path2D.Double();
            boolean draws = false;
            for (MotionHistory.Torques here : torques) {
                final double torque_Nm = joint < here.torque_Nm.length ? here.torque_Nm[joint] : Double.NaN;
                if (!Double.isFinite(torque_Nm)) {
                    draws = false; // not measured: a gap
                    continue;
                }
                final double px = x(here.time_s, end_s, plotWidth);
                final double py = top + scale * (high - torque_Nm);
                if (draws) {
                    path.lineTo(px, py);
                } else {
                    path.moveTo(px, py);
                }
                draws = true;
            }
            g.setColor(JOINTS[joint % JOINTS.length]);
            g.draw(path);
        }
    }

    private static void axes(Graphics2D g, double low, double high, int plotWidth, int top, int bottom) {
        g.setStroke(new BasicStroke(1.0f));
        final double step_Nm = niceStep((high - low) / 4.0);
        for (double torque_Nm = Math.ceil(low / step_Nm) * step_Nm; torque_Nm <= high; torque_Nm += step_Nm) {
            final int y = (int) (top + (bottom - top) * (high - torque_Nm) / (high - low));
            g.setColor(new Color(0xE4E4E4));
            g.drawLine(LEFT, y, LEFT + plotWidth, y);
            g.setColor(Color.DARK_GRAY);
            g.drawString(String.format("%.1f", torque_Nm), 6, y + 5);
        }
        for (int second = 0; second <= (int) MotionHistory.SECONDS; second += 2) {
            final int x = (int) x(-second, 0.0, plotWidth);
            g.drawString(second == 0 ? "now" : "-" + second + " s", x - 20, bottom + 16);
        }
    }

    /** 1, 2 or 5 times a power of ten, not below `least`. */
    private static double niceStep(double least) {
        final double power = Math.pow(10.0, Math.floor(Math.log10(least)));
        for (double factor : new double[] {1.0, 2.0, 5.0}) {
            if (factor * power >= least) {
                return factor * power;
            }
        }
        return 10.0 * power;
    }

    private void legend(Graphics2D g, List<MotionHistory.Torques> torques, int baseline, int width) {
        final int count = torques.isEmpty() ? 0 : torques.get(torques.size() - 1).torque_Nm.length;
        int x = LEFT;
        int y = baseline;
        for (int joint = 0; joint < count; ++joint) {
            final String text = name(joints, joint, "joint");
            final int needed = 30 + g.getFontMetrics().stringWidth(text);
            if (x + needed > width - RIGHT) {
                x = LEFT;
                y += 16;
            }
            g.setColor(JOINTS[joint % JOINTS.length]);
            g.fillRect(x, y - 7, 14, 4);
            g.setColor(Color.BLACK);
            g.drawString(text, x + 18, y);
            x += needed;
        }
    }

    private static String name(String[] names, int index, String kind) {
        return index < names.length && !names[index].isEmpty() ? names[index] : kind + " " + index;
    }

    private static String phaseName(int phase) {
        final String key = Integer.toString(phase);
        return NAMES.containsKey(key) ? NAMES.getString(key) : "phase " + key;
    }
}
