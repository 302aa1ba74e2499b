# Where the model's own steady states are stable: the branches against ℬ, their rates, the thresholds.


rule trace_states:
    output:
        table="results/tables/states.csv",
        thresholds="results/tables/state_thresholds.csv",
    log:
        "results/logs/trace_states.log",
    benchmark:
        "results/benchmarks/trace_states.tsv"
    conda:
        "../../envs/analysis.yaml"
    threads: 1
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=code_of("trace_states"),
        options=STUDY.states_options,
    message:
        "trace the steady states and find where they are stable"
    shell:
        "sedfiber trace_states {params.options}"
        " -o {output.table} --thresholds {output.thresholds} > {log} 2>&1"


rule states:
    input:
        figures_of("states"),
